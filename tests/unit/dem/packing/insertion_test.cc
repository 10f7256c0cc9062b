#include <dem/packing/gradation.h>
#include <dem/packing/insertion.h>

#include <gtest/gtest.h>

#include <shape/test_shapes.h>

namespace
{
std::vector<dem::ParticleShape> particles(bool is_shaped)
{
  std::vector<std::shared_ptr<const dem::Coefficients>> shapes;
  if (is_shaped)
    shapes.push_back(std::make_shared<const dem::Coefficients>(
        dem::test::random_particle(20, 4)));
  dem::Random random(1);
  return dem::draw_particles({{7e-3, 12e-3}, {0., 1.}}, 4e-5, shapes, random);
}

double reach(const dem::ParticleShape &body, const dem::Placement &placement,
             const dem::Vec3 &direction)
{
  return body.series
             ? body.scale *
                   dem::radius(*body.series,
                               placement.orientation.conjugate() * direction)
             : body.scale;
}

const dem::Vec3 lower(-0.01, 0., 0.02), upper(0.04, 0.05, 0.07);
} // namespace

// Every pair by brute force, and every face.
TEST(Insertion, NothingOverlaps)
{
  for (const bool is_shaped : {false, true})
  {
    const std::vector<dem::ParticleShape> bodies = particles(is_shaped);
    dem::Random random(5);
    const std::vector<dem::Placement> placements =
        dem::insert_particles(bodies, {lower, upper}, random);
    ASSERT_EQ(placements.size(), bodies.size());
    for (std::size_t i = 0; i < bodies.size(); ++i)
    {
      for (int d = 0; d < 3; ++d)
      {
        const dem::Vec3 axis = dem::Vec3::Unit(d);
        EXPECT_GE(placements[i].position[d] -
                      reach(bodies[i], placements[i], -axis),
                  lower[d]);
        EXPECT_LE(placements[i].position[d] +
                      reach(bodies[i], placements[i], axis),
                  upper[d]);
      }
      for (std::size_t j = 0; j < i; ++j)
      {
        const dem::Vec3 branch =
            placements[j].position - placements[i].position;
        const dem::Vec3 u = branch.normalized();
        EXPECT_GT(branch.norm(), reach(bodies[i], placements[i], u) +
                                     reach(bodies[j], placements[j], -u));
      }
    }
  }
}

TEST(Insertion, SeedSettlesThePlacements)
{
  const std::vector<dem::ParticleShape> bodies = particles(true);
  const auto insert = [&](std::uint64_t seed)
  {
    dem::Random random(seed);
    return dem::insert_particles(bodies, {lower, upper}, random);
  };
  const auto first = insert(5), again = insert(5), other = insert(6);
  for (std::size_t k = 0; k < first.size(); ++k)
  {
    EXPECT_EQ(first[k].position, again[k].position);
    EXPECT_EQ(first[k].orientation.coeffs(), again[k].orientation.coeffs());
    EXPECT_NE(first[k].position, other[k].position);
  }
}

TEST(Insertion, FullBoxIsRefused)
{
  const std::vector<dem::ParticleShape> bodies(30, dem::make_sphere(0.01));
  dem::Random random(1);
  EXPECT_THROW(dem::insert_particles(bodies, {lower, upper}, random),
               std::runtime_error);
}
