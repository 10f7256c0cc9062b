// A specimen whose sides are periodic, between two plates.
#include "case/file.h"
#include "triaxial/triaxial.h"

#include <coupling/enclosed_specimen.h>
#include <dem/engine_boundaries.h>

#include <gtest/gtest.h>

namespace
{
using namespace spall;

constexpr double pressure = 30e3; // [Pa]

Case periodic_case(std::vector<Override> overrides = {})
{
  overrides.push_back({"Boundary", "lateral", "periodic"});
  return read_case(SPALL_SMALL_CASE, overrides);
}

void run_to(Triaxial &test, Stage stage)
{
  while (test.stage() < stage)
    test.advance();
  test.engine().synchronize();
}
} // namespace

// What the contacts bear is what goes through faces and plates and what
// accelerates the particles, at any instant: an identity of its diagonals. The
// boundary's part is a sum over the contacts across the faces alone.
TEST(PeriodicSides, ParticlesBearWhatGoesThroughTheFaces)
{
  Triaxial test(periodic_case());
  run_to(test, Stage::consolidation);
  EXPECT_TRUE(test.engine().cell().is_periodic(0));
  EXPECT_TRUE(test.engine().cell().is_periodic(1));
  EXPECT_FALSE(test.engine().cell().is_periodic(2));
  EXPECT_EQ(dem::planes(test.engine()).size(), 2u);
  for (int step = 0; step < 200; ++step)
    test.advance();
  test.engine().synchronize();
  const coupling::StressBalance b = test.stress_balance(test.synchronized());
  const dem::Mat3 rest = b.particles - b.boundary - b.unrest;
  EXPECT_LT(rest.diagonal().cwiseAbs().maxCoeff(), 1e-9 * pressure);
  EXPECT_GT(b.boundary(0, 0), 0.5 * pressure);
}

// The specimen has no skin: near a face it is as dense as elsewhere, which
// rigid sides make looser by a third of its pores.
TEST(PeriodicSides, HaveNoLooseSkin)
{
  Triaxial test(periodic_case());
  run_to(test, Stage::consolidation);
  const dem::BoundaryProfile profile =
      coupling::boundary_profile(test.enclosed(test.synchronized()));
  // The points of the profile count overlaps once, and are some 1e5.
  EXPECT_NEAR(profile.porosity, test.prepared().porosity, 0.02);
  EXPECT_NEAR(profile.porosity_skin, profile.porosity_inside, 0.05);
}

// Stress path, volume and energies of a few cycles.
TEST(PeriodicSides, FollowTheLoad)
{
  Triaxial test(periodic_case({{"Breakage", "is_active", "false"}}));
  run_to(test, Stage::loading);
  double lateral = 0., work = 0., worst = 0.;
  int n = 0;
  for (; test.stage() < Stage::done; ++n)
  {
    test.advance();
    if (n % 50 != 0)
      continue;
    test.engine().synchronize();
    const Sample now = test.sample(1.);
    lateral = std::max(lateral, std::abs(now.lateral_stress / pressure - 1.));
    work = std::max(work, std::abs(now.external_work));
    worst = std::max(worst, std::abs(now.energy_residual));
    const dem::Vec3 size = dem::box_size(test.engine(), test.walls());
    EXPECT_NEAR(size.prod(),
                coupling::enclosed_volume(test.enclosed(test.synchronized())),
                1e-12 * size.prod());
  }
  EXPECT_LT(lateral, 0.1);
  EXPECT_LT(worst, 1e-3 * work);
}
