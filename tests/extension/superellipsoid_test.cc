#include "superellipsoid.h"

#include <dem/engine_boundaries.h>
#include <dem/shape/measures.h>
#include <dem/shape/particle_shape.h>
#include <dem/shape/quadrature.h>
#include <dem/shape/spherical_harmonics.h>

#include <gtest/gtest.h>

#include <cmath>
#include <dem_scene.h>
#include <memory>
#include <numbers>
#include <stdexcept>

namespace
{
const Superellipsoid rounded_box{{0.012, 0.01, 0.008}, 3.};

dem::ParticleShape particle()
{
  auto series = std::make_shared<const dem::Coefficients>(
      coefficients_of(rounded_box, 20));
  const double mean = (*series)[0] / std::sqrt(4. * std::numbers::pi);
  return dem::make_shape(series, mean, dem::standard_quadrature());
}
} // namespace

// V = 8 a b c Gamma(1 + 1/p)^3 / Gamma(1 + 3/p).
TEST(Superellipsoid, SeriesHasTheVolumeOfTheClosedForm)
{
  const double p = rounded_box.exponent;
  const double expected = 8. * rounded_box.semi_axes.prod() *
                          std::pow(std::tgamma(1. + 1. / p), 3) /
                          std::tgamma(1. + 3. / p);
  EXPECT_NEAR(particle().volume, expected, 1e-3 * expected);
}

// On a plane it presses with the overlap of its own radius there, which is c.
TEST(Superellipsoid, PressesOnAPlane)
{
  dem::EngineParameters parameters = support::bare_parameters();
  parameters.wall.normal_stiffness = 1e6;
  parameters.geometry.wall_geometry = dem::ContactGeometry::radial;
  dem::Engine engine(parameters);
  const dem::ParticleShape shape = particle();
  const double c = rounded_box.semi_axes.z(), height = 0.99 * c,
               reach =
                   shape.scale * dem::radius(*shape.series, dem::Vec3::UnitZ());
  EXPECT_NEAR(reach, c, 2e-3 * c);
  engine.add_particle(shape, height * dem::Vec3::UnitZ(),
                      dem::Quaternion::Identity());
  dem::add_plane(engine, dem::Vec3::Zero(), dem::Vec3::UnitZ());
  engine.evaluate(1e-7);
  const double expected = 1e6 * (reach - height);
  EXPECT_NEAR(engine.particles().load[0].force.z(), expected, 0.01 * expected);
}

TEST(Superellipsoid, RadiusThatIsNoneIsRefused)
{
  EXPECT_THROW(dem::fit_radius([](const dem::Vec3 &) { return 0.; }, 4),
               std::invalid_argument);
  EXPECT_THROW(
      dem::fit_radius([](const dem::Vec3 &) { return 1.; }, dem::max_order + 1),
      std::invalid_argument);
}
