#include "case/fields.h"
#include "case/file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <iterator>

namespace
{
using namespace spall;
namespace fs = std::filesystem;

/// The quick case of a kind under a preset, checked as `spall run` does.
Case quick_case(const std::string &kind, const std::string &preset)
{
  const fs::path cases = fs::path(SPALL_DATA) / "cases";
  const fs::path quick = cases / (kind + "_quick.prm");
  const std::vector<Override> over = {parse_override("preset=" + preset)};
  return read_case(
      (fs::exists(quick) ? quick : cases / (kind + ".prm")).string(), over);
}

// Every preset of every kind passes the checks of the quick case of its kind.
TEST(Presets, EveryKindHasThem)
{
  for (const TestKind &kind : test_kinds())
    for (const char *preset : {"article", "fast", "standard", "reference"})
      EXPECT_NO_THROW(quick_case(kind.name, preset))
          << kind.name << " " << preset;
}

TEST(Presets, NoneIsLeftOver)
{
  for (const auto &kind :
       fs::directory_iterator(fs::path(SPALL_DATA) / "presets"))
  {
    EXPECT_TRUE(find_kind(kind.path().filename().string())) << kind.path();
    EXPECT_EQ(std::distance(fs::directory_iterator(kind.path()),
                            fs::directory_iterator{}),
              4)
        << kind.path();
  }
}

// What the names promise, whatever the case had.
TEST(Presets, GeometryAndStepAreThoseOfTheName)
{
  using enum dem::ContactGeometry;
  for (const TestKind &kind : test_kinds())
  {
    // With its true surface a single particle turns out of the load.
    const bool is_single = kind.name == "single_particle";
    const Case fast = quick_case(kind.name, "fast"),
               standard = quick_case(kind.name, "standard"),
               reference = quick_case(kind.name, "reference");
    EXPECT_EQ(fast.contact.geometry, is_single ? radial : sphere) << kind.name;
    for (const Case *one : {&standard, &reference})
    {
      EXPECT_EQ(one->contact.geometry, is_single ? radial : surface);
      EXPECT_EQ(one->contact.wall_geometry, one->contact.geometry);
    }
    if (is_single)
    {
      EXPECT_EQ(reference.time.fixed_step, 0.5 * standard.time.fixed_step);
      continue;
    }
    EXPECT_EQ(reference.time.step, StepRule::stable);
    EXPECT_EQ(reference.time.safety, 0.4);
    EXPECT_EQ(standard.time.safety, 0.8);
  }
}

// Table 2 of the publication. Boundaries: docs/results/presets.md.
TEST(Presets, ArticleHasTheValuesOfThePublication)
{
  for (const TestKind &kind : test_kinds())
  {
    const Case c = quick_case(kind.name, "article");
    EXPECT_EQ(c.contact.geometry, dem::ContactGeometry::radial) << kind.name;
    EXPECT_EQ(c.time.step, StepRule::fixed);
    EXPECT_EQ(c.time.fixed_step, 1e-6);
    EXPECT_EQ(c.particle.density, 2750.);
    EXPECT_EQ(c.particle.shear_modulus, 5e8);
    EXPECT_EQ(c.particle.poisson_ratio, 0.25);
    EXPECT_EQ(c.particle.friction, 0.5);
    EXPECT_EQ(c.particle.rolling_friction, 0.2);
    EXPECT_EQ(c.particle.normal_damping, 0.27);
    EXPECT_EQ(c.particle.shear_damping, 0.27);
    EXPECT_EQ(c.wall.friction, 0.21);
    EXPECT_EQ(c.wall.normal_damping, 0.62);
    EXPECT_EQ(c.wall.shear_damping, 0.62);
    EXPECT_EQ(c.wall.shear_stiffness, 0.85 * c.wall.normal_stiffness);
    EXPECT_EQ(c.wall.law, kind.name == "single_particle" ? "hertz" : "linear");
    EXPECT_EQ(c.breakage.fracture_energy, 1e4);
    EXPECT_EQ(c.breakage.min_equivalent_radius, 2e-3);
    EXPECT_EQ(2 * c.breakage.quadrature_rings * c.breakage.quadrature_rings,
              3200);
  }
}
} // namespace
