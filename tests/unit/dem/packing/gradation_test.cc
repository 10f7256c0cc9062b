#include <dem/packing/gradation.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <shape/test_shapes.h>

namespace
{
const dem::GradingCurve curve{{7.1e-3, 10e-3, 16e-3, 22.4e-3},
                              {0., 0.2, 0.7, 1.}};

using Shapes = std::vector<std::shared_ptr<const dem::Coefficients>>;

Shapes two_shapes()
{
  Shapes shapes;
  for (const unsigned seed : {1u, 2u})
    shapes.push_back(std::make_shared<const dem::Coefficients>(
        dem::test::random_particle(20, seed)));
  return shapes;
}

double volume_of(const std::vector<dem::ParticleShape> &particles)
{
  double sum = 0.;
  for (const dem::ParticleShape &particle : particles)
    sum += particle.volume;
  return sum;
}

/// Share of the volume in particles finer than this diameter [-].
double passing(const std::vector<dem::ParticleShape> &particles,
               double diameter)
{
  double sum = 0.;
  for (const dem::ParticleShape &particle : particles)
    if (2. * dem::mean_radius(particle) < diameter)
      sum += particle.volume;
  return sum / volume_of(particles);
}
} // namespace

namespace
{
/// Mass of the largest particle of a size over that of a sphere [-].
double volume_factor(const Shapes &shapes)
{
  double factor = shapes.empty() ? 1. : 0.;
  for (const auto &shape : shapes)
    factor = std::max(factor, dem::make_shape(shape, 0.5).volume /
                                  (std::numbers::pi / 6.));
  return factor;
}

/// Volume of the particles that are at most this large [m^3].
double finer_volume(const std::vector<dem::ParticleShape> &particles,
                    double diameter)
{
  double sum = 0.;
  for (const dem::ParticleShape &particle : particles)
    if (2. * dem::mean_radius(particle) <= diameter * (1. + 1e-12))
      sum += particle.volume;
  return sum;
}

/// At every sieve the volume that passes is that of the table to the volume of
/// one particle of the size of the sieve, and no particle has a size where the
/// table is flat.
void expect_table(const dem::GradingCurve &table, double solid_volume,
                  const Shapes &shapes)
{
  dem::Random random(5);
  const std::vector<dem::ParticleShape> particles =
      dem::draw_particles(table, solid_volume, shapes, random);
  const double factor = volume_factor(shapes);
  for (std::size_t k = 0; k < table.diameter.size(); ++k)
  {
    const double d = table.diameter[k];
    EXPECT_NEAR(finer_volume(particles, d), solid_volume * table.passing[k],
                factor * std::numbers::pi / 6. * d * d * d)
        << "sieve " << d << " m, " << shapes.size() << " shapes";
    if (k == 0 || table.passing[k] > table.passing[k - 1])
      continue;
    for (const dem::ParticleShape &particle : particles)
    {
      const double size = 2. * dem::mean_radius(particle);
      EXPECT_FALSE(size > table.diameter[k - 1] * (1. + 1e-12) &&
                   size < d * (1. - 1e-12))
          << size << " m is where the table is flat";
    }
  }
}

// Tables that sieve analyses give.
const dem::GradingCurve flat_start{{1e-4, 0.020, 0.025}, {0., 0., 1.}},
    flat_end{{0.020, 0.025, 0.0315}, {0., 1., 1.}},
    gap_graded{{0.004, 0.008, 0.04, 0.0415}, {0., 0.05, 0.05, 1.}},
    nearly_flat{{0.004, 0.008, 0.04, 0.0415}, {0., 0.05, 0.051, 1.}},
    two_gaps{{0.005, 0.006, 0.012, 0.013, 0.027, 0.030},
             {0., 0.2, 0.2, 0.5, 0.5, 1.}},
    uniform{{0.010, 0.0125}, {0., 1.}}, single_size{{0.020, 0.02001}, {0., 1.}},
    long_table{{6.3e-5, 1.25e-4, 2.5e-4, 5e-4, 1e-3, 2e-3, 4e-3, 8e-3, 0.0112,
                0.016, 0.020, 0.025, 0.0315, 0.045, 0.063},
               {0., 0., 0., 0., 0., 0., 0., 0., 0., 0., 0., 1., 1., 1., 1.}},
    well_graded{{0.004, 0.0056, 0.008, 0.0112, 0.016, 0.0224, 0.0315, 0.045},
                {0., 0.02, 0.1, 0.26, 0.45, 0.7, 0.93, 1.}};
} // namespace

TEST(Gradation, SievesPassWhatTheTableAsks)
{
  for (const Shapes &shapes : {Shapes{}, two_shapes()})
    for (const dem::GradingCurve *table :
         {&flat_start, &flat_end, &gap_graded, &nearly_flat, &two_gaps,
          &uniform, &single_size, &long_table, &well_graded})
      for (const double solid_volume : {7.4e-3, 3e-4})
        expect_table(*table, solid_volume, shapes);
}

// Rows outside the content of a table have no effect.
TEST(Gradation, RowsOutsideTheContentHaveNoEffect)
{
  const dem::GradingCurve content{{0.020, 0.025}, {0., 1.}};
  const auto draw = [](const dem::GradingCurve &table)
  {
    dem::Random random(2);
    std::vector<double> volumes;
    for (const dem::ParticleShape &body :
         dem::draw_particles(table, 1e-3, {}, random))
      volumes.push_back(body.volume);
    return volumes;
  };
  EXPECT_EQ(draw(flat_start), draw(content));
  EXPECT_EQ(draw(flat_end), draw(content));
  EXPECT_EQ(draw(long_table), draw(content));
}

// A class of the curve is filled to half a particle: the largest are 5.9e-6
// m^3, 0.6 % of the volume.
TEST(Gradation, ParticlesFollowTheCurve)
{
  const double solid_volume = 1e-3;
  for (const Shapes &shapes : {Shapes{}, two_shapes()})
  {
    dem::Random random(3);
    const std::vector<dem::ParticleShape> particles =
        dem::draw_particles(curve, solid_volume, shapes, random);
    // Half a smallest particle is 1e-7 m^3.
    EXPECT_NEAR(volume_of(particles), solid_volume, 1.5e-7);
    for (std::size_t k = 0; k < curve.diameter.size(); ++k)
      EXPECT_NEAR(passing(particles, curve.diameter[k] * (1. + 1e-12)),
                  curve.passing[k], 0.01);
    // Straight in ln d between the points; a class is 3 % wide.
    EXPECT_NEAR(passing(particles, std::sqrt(10e-3 * 16e-3)), 0.45, 0.03);
    for (std::size_t k = 1; k < particles.size(); ++k)
      EXPECT_LE(particles[k].volume, particles[k - 1].volume);
  }
}

TEST(Gradation, EveryShapeIsUsed)
{
  const Shapes shapes = two_shapes();
  dem::Random random(3);
  int n_first = 0;
  const auto particles = dem::draw_particles(curve, 1e-3, shapes, random);
  for (const dem::ParticleShape &particle : particles)
    n_first += particle.series == shapes[0];
  // Four standard deviations of a fair coin.
  const double n = double(particles.size());
  EXPECT_NEAR(n_first, 0.5 * n, 2. * std::sqrt(n));
}

TEST(Gradation, RefusesMoreThanMemoryHolds)
{
  dem::Random random(1);
  EXPECT_THROW(dem::draw_particles(curve, 1e6, {}, random),
               std::invalid_argument);
}

TEST(Gradation, SeedSettlesTheParticles)
{
  const Shapes shapes = two_shapes();
  const auto draw = [&](std::uint64_t seed)
  {
    dem::Random random(seed);
    return dem::draw_particles(curve, 1e-4, shapes, random);
  };
  const auto first = draw(7), again = draw(7), other = draw(8);
  ASSERT_EQ(first.size(), again.size());
  bool is_other = other.size() != first.size();
  for (std::size_t k = 0; k < first.size(); ++k)
  {
    EXPECT_EQ(first[k].volume, again[k].volume);
    EXPECT_EQ(first[k].series, again[k].series);
    is_other = is_other || first[k].volume != other[k].volume;
  }
  EXPECT_TRUE(is_other);
}

// Numbers of mt19937_64 are the same everywhere, and so are ours.
TEST(Random, UniformAndRotation)
{
  dem::Random random(1), same(1);
  dem::Vec3 sum = dem::Vec3::Zero();
  constexpr int n = 20000;
  for (int k = 0; k < n; ++k)
  {
    const double u = random.uniform();
    ASSERT_EQ(u, same.uniform());
    ASSERT_TRUE(u >= 0. && u < 1.);
    ASSERT_LT(random.below(7), 7u);
    same.below(7);
    const dem::Quaternion q = random.rotation();
    same.rotation();
    ASSERT_NEAR(q.norm(), 1., 1e-14);
    const dem::Vec3 axis = q * dem::Vec3::UnitX();
    sum += axis.cwiseAbs2();
  }
  // Mean squares 1/3 with a deviation of sqrt(4/45 / n) = 0.002.
  EXPECT_LT((sum / n - dem::Vec3::Constant(1. / 3.)).cwiseAbs().maxCoeff(),
            0.01);
}
