#include <dem/contact/law_table.h>
#include <dem/integrate/stable_step.h>
#include <dem/integrate/time_step.h>
#include <dem/measure/contact_springs.h>

#include <gtest/gtest.h>

#include <cone_law.h>
#include <dem_scene.h>
#include <test_laws.h>

namespace baseline
{
extern const dem::kernel::Loops reordered_loops, pulling_loops;
}
namespace avx2
{
extern const dem::kernel::Loops reordered_loops, pulling_loops;
}
namespace avx512
{
extern const dem::kernel::Loops reordered_loops, pulling_loops;
}

namespace
{
constexpr double radius = 5e-3, stiffness = 1e7, ratio = 0.85, speed = 0.2;

void add_laws()
{
  static const bool is_added = []
  {
    dem::add_contact_law(dem::contact_law_entry<Reordered>(
        dem::loops_by_instruction_set<baseline::reordered_loops,
                                      avx2::reordered_loops,
                                      avx512::reordered_loops>));
    dem::add_contact_law(dem::contact_law_entry<Pulling>(
        dem::loops_by_instruction_set<baseline::pulling_loops,
                                      avx2::pulling_loops,
                                      avx512::pulling_loops>));
    return true;
  }();
  ASSERT_TRUE(is_added);
}

/// Springs of these stiffnesses on walls and particles, by one law or another.
dem::EngineParameters spring_parameters(bool is_reordered)
{
  add_laws();
  dem::EngineParameters p = support::bare_parameters();
  p.wall.friction = p.particle.friction = 0.5;
  p.wall.normal_stiffness = p.wall.shear_stiffness = 1e3; // of another law
  if (is_reordered)
  {
    p.wall.law = p.particle.law = Reordered::name;
    p.wall.law_values = p.particle.law_values = {ratio, stiffness};
  }
  else
  {
    p.wall.normal_stiffness = stiffness;
    p.wall.shear_stiffness = ratio * stiffness;
    p.particle.law = "linear";
    p.particle.law_values = {stiffness, ratio * stiffness};
  }
  return p;
}

dem::Engine on_plane(const dem::EngineParameters &p, double overlap)
{
  dem::Engine engine(p);
  support::add_sphere(engine, radius, {0., 0., radius - overlap});
  dem::add_plane(engine, dem::Vec3::Zero(), dem::Vec3::UnitZ());
  engine.evaluate(1e-9);
  return engine;
}

/// Two spheres that meet; their speed when they have parted [m/s].
double speed_after_impact(const dem::EngineParameters &p, double gap,
                          double step)
{
  dem::Engine engine(p);
  support::add_sphere(engine, radius, {-radius - 0.5 * gap, 0., 0.});
  support::add_sphere(engine, radius, {radius + 0.5 * gap, 0., 0.});
  engine.particles().velocity(0).x() = 0.5 * speed;
  engine.particles().velocity(1).x() = -0.5 * speed;
  const auto gap_now = [&engine]
  {
    return engine.particles().position(1).x() -
           engine.particles().position(0).x() - 2. * radius;
  };
  for (int n = 0; n < 100 || gap_now() < gap; ++n)
    engine.advance(step);
  return engine.particles().velocity(1).x() -
         engine.particles().velocity(0).x();
}

double impact_duration(double normal_stiffness, const dem::EngineParameters &p)
{
  const double reduced =
      0.5 * dem::make_sphere(radius).volume * p.particle.density;
  return std::numbers::pi * std::sqrt(reduced / normal_stiffness);
}
} // namespace

// The keys of the law linear say nothing of another law.
TEST(OwnLaw, StableStepsAreThoseOfItsSprings)
{
  const dem::EngineParameters mine = spring_parameters(true),
                              linear = spring_parameters(false);
  const dem::Engine one = on_plane(mine, 1e-6), other = on_plane(linear, 1e-6);
  const auto network = dem::contact_springs(one, 0.),
             expected = dem::contact_springs(other, 0.);
  ASSERT_EQ(network.n_contacts(), 1u);
  EXPECT_EQ(network.normal_stiffness, expected.normal_stiffness);
  EXPECT_EQ(network.shear_stiffness, expected.shear_stiffness);
  EXPECT_EQ(network.normal_stiffness[0], stiffness);
  EXPECT_EQ(dem::critical_step(mine, one.particles(), "").step,
            dem::critical_step(linear, other.particles(), "").step);
  EXPECT_EQ(dem::corner_step(mine, one.particles()),
            dem::corner_step(linear, other.particles()));
}

TEST(OwnLaw, SpringOnAWallHasTheTangentOfTheLaw)
{
  add_laws();
  dem::EngineParameters p = spring_parameters(false);
  static const bool is_added = (add_cone_law(), true);
  p.wall.law = is_added ? Cone::name : "";
  p.wall.law_values = {4e9, 0.8};
  const auto network = dem::contact_springs(on_plane(p, 1e-5), 0.);
  ASSERT_EQ(network.n_contacts(), 1u);
  EXPECT_NEAR(network.normal_stiffness[0], 2. * 4e9 * 1e-5, 1e-3);
}

TEST(OwnLaw, OrderOfTheValuesDoesNotMatter)
{
  const dem::EngineParameters linear = spring_parameters(false);
  const double step = impact_duration(stiffness, linear) / 15.;
  EXPECT_NEAR(speed_after_impact(spring_parameters(true), 1e-6, step),
              speed_after_impact(linear, 1e-6, step), 1e-12);
}

// 3e-5 with 500 steps; 2e-3 if the pull were cut off where touching begins.
TEST(OwnLaw, ConstantSpringsThatPullKeepTheEnergy)
{
  add_laws();
  dem::EngineParameters p = support::bare_parameters();
  p.particle.law = Pulling::name;
  p.particle.law_values = {stiffness, 2., 2e-5};
  const double step = impact_duration(stiffness, p) / 500.;
  EXPECT_NEAR(speed_after_impact(p, 3e-5, step), speed, 2e-4 * speed);
}

TEST(OwnLaw, KeysOfOthersAndTooManyAreRefused)
{
  const auto refusal = [](std::vector<dem::LawParameter> parameters)
  {
    try
    {
      dem::add_contact_law(
          {.name = "refused", .parameters = std::move(parameters)});
    }
    catch (const std::invalid_argument &fault)
    {
      return std::string(fault.what());
    }
    return std::string();
  };
  const dem::LawParameter taken{"work_of_adhesion", "-", 1., 0., 2., ""},
      free{"one", "-", 1., 0., 2., ""};
  EXPECT_EQ(refusal({free, taken}), "contact law refused: its key "
                                    "work_of_adhesion belongs to the law dmt");
  EXPECT_EQ(refusal({free, free, free, free, free}),
            "contact law refused: has 5 parameters, at most 4 are possible");
}
