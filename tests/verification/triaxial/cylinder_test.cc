// A cylinder of particles in its membrane, at rest under the confining
// pressure.
#include "case/file.h"
#include "triaxial/triaxial.h"

#include <dem/engine_boundaries.h>
#include <dem/measure/assembly.h>
#include <dem/measure/network.h>

#include <gtest/gtest.h>

#include <numbers>

namespace
{
using namespace spall;

constexpr double pressure = 30e3; // [Pa]

Case cylinder_case(double membrane_modulus,
                   const char *lateral_side = "membrane")
{
  const std::vector<Override> overrides = {
      {"Boundary", "lateral", lateral_side},
      {"Specimen", "form", "cylinder"},
      {"Specimen", "diameter", "0.05"},
      {"Specimen", "height", "0.08"},
      {"Membrane", "youngs_modulus", std::to_string(membrane_modulus)},
      {"Boundary", "elements_around", "24"},
      {"Loading", "consolidation_time", "0.12"},
      {"Time", "local_damping", "0.7"}};
  return read_case(SPALL_SMALL_CASE, overrides);
}

void run_to(Triaxial &test, Stage stage)
{
  while (test.stage() < stage)
    test.advance();
  test.engine().synchronize();
}

/// What the plates carry across by friction, mean of xx and yy [Pa].
double plate_friction(const Triaxial &test)
{
  double sum = 0.;
  for (const dem::WallContact &wall :
       dem::contact_network_of(test.engine()).walls)
    if (!wall.is_on_facets)
      sum -= wall.force.head<2>().dot(wall.point.head<2>());
  return 0.5 * sum / test.membrane()->enclosed_volume();
}

/// What is left of the balance, its largest component [Pa].
double residual(const coupling::StressBalance &b)
{
  return (b.particles + b.membrane - b.boundary - b.unrest)
      .cwiseAbs()
      .maxCoeff();
}

/// Upward speed of the plate [m/s] and its height above the other [m].
struct PlateMotion
{
  double speed = 0., height = 0.;
};

PlateMotion plate_motion(const Triaxial &test)
{
  const auto &planes = dem::planes(test.engine());
  return {planes[1].velocity.z(), planes[1].point.z() - planes[0].point.z()};
}

struct Means
{
  coupling::StressBalance stress;                               ///< [Pa]
  double plate = 0., friction = 0., residual = 0., unrest = 0.; ///< [Pa]
  /// What speeds the plate up, over the section [Pa].
  double swing = 0.;
};

/// Over the last third of the consolidation, in which plate and particles still
/// swing; of `residual` and `unrest` the largest.
Means consolidate(Triaxial &test, double plate_mass)
{
  run_to(test, Stage::consolidation);
  const double rest = test.engine().time() + 0.08;
  while (test.engine().time() < rest)
    test.advance();
  test.engine().synchronize();
  const PlateMotion first = plate_motion(test);
  Means means;
  int n = 0;
  for (int step = 0; test.stage() < Stage::loading; ++step)
  {
    test.advance();
    if (step % 20 != 0)
      continue;
    test.engine().synchronize();
    ++n;
    const coupling::StressBalance now =
        test.stress_balance(test.synchronized());
    means.stress.particles += now.particles;
    means.stress.membrane += now.membrane;
    means.stress.boundary += now.boundary;
    means.stress.unrest += now.unrest;
    means.plate += test.sample(1.).axial_stress;
    means.friction += plate_friction(test);
    means.residual = std::max(means.residual, residual(now));
    means.unrest = std::max(means.unrest, now.unrest.cwiseAbs().maxCoeff());
  }
  for (dem::Mat3 *sum : {&means.stress.particles, &means.stress.membrane,
                         &means.stress.boundary, &means.stress.unrest})
    *sum /= n;
  means.plate /= n, means.friction /= n;
  const PlateMotion last = plate_motion(test);
  means.swing = plate_mass * (last.speed - first.speed) /
                (test.engine().time() - rest) * last.height /
                test.membrane()->enclosed_volume();
  return means;
}

void print(const char *name, const dem::Mat3 &stress)
{
  std::printf("%-9s lateral %8.1f axial %8.1f\n", name,
              coupling::lateral(stress), coupling::axial(stress));
}
} // namespace

// Before the membrane moves its volume is that of a prism of 24 sides that
// touch the cylinder, and the plate is as wide.
TEST(Cylinder, VolumeOfTheMembraneIsThatOfThePrism)
{
  Triaxial test(cylinder_case(1.4e6));
  double diameter = 0., height = 0.;
  test.when_prepared(
      [&]
      {
        diameter = 2. * dem::drum(test.engine()).radius;
        height = dem::planes(test.engine())[1].point.z() -
                 dem::planes(test.engine())[0].point.z();
      });
  run_to(test, Stage::consolidation);
  const double section =
      24. * 0.25 * diameter * diameter * std::tan(std::numbers::pi / 24.);
  EXPECT_NEAR(test.membrane()->enclosed_volume(), section * height,
              1e-9 * section * height);
  // Solid volume over that of the round cylinder.
  const double round = 0.25 * std::numbers::pi * diameter * diameter * height;
  EXPECT_NEAR(1. - dem::solid_volume(test.engine().particles(), test.ranks()) /
                       round,
              test.prepared().porosity, 1e-9);
}

// At any instant particles and membrane together bear what presses from outside
// and what accelerates them. It is an identity, so nothing but round-off is
// left although plate and particles swing; forces, contact points, stresses of
// quads and the enclosed volume come from separate sums. Round-off of sums of
// some thousand forces times positions, 1e-11 of the pressure, has a margin of
// thirty.
TEST(Cylinder, ParticlesAndMembraneBearTheBoundary)
{
  for (const double modulus : {1e5, 1.4e6})
  {
    const Case parameters = cylinder_case(modulus);
    Triaxial test(parameters);
    const Means means = consolidate(test, parameters.boundary.plate_mass);
    const coupling::StressBalance &stress = means.stress;
    std::printf("E = %g Pa: plate %.0f, its swing %.0f, residual %.1e, unrest "
                "%.0f at most\n",
                modulus, means.plate, means.swing, means.residual,
                means.unrest);
    print("particles", stress.particles);
    print("membrane", stress.membrane);
    print("boundary", stress.boundary);
    print("unrest", stress.unrest);
    std::printf("lateral: friction of plates %.1f, rims %.1f\n", means.friction,
                coupling::lateral(stress.boundary) - pressure - means.friction);
    EXPECT_LT(means.residual, 1e-9 * pressure);
    // The plate carries the confining pressure and what speeds it up.
    EXPECT_NEAR(coupling::axial(stress.boundary), pressure + means.swing,
                1e-3 * pressure);
  }
}

// The same between rigid sides, round and flat, which count as plates; the
// friction of the particles has just come back, so they move.
TEST(Cylinder, ParticlesBearTheRigidSides)
{
  for (const char *form : {"cylinder", "box"})
  {
    Case parameters = cylinder_case(1.4e6, "rigid");
    if (std::string(form) == "box")
      parameters.specimen.form = SpecimenForm::box;
    Triaxial test(parameters);
    run_to(test, Stage::consolidation);
    for (int step = 0; step < 200; ++step)
      test.advance();
    test.engine().synchronize();
    EXPECT_LT(residual(test.stress_balance(test.synchronized())),
              1e-9 * pressure)
        << form;
  }
}
