#include "scenes.h"

#include <dem/shape/spherical_harmonics.h>

#include <cmath>
#include <numbers>

namespace spall::verify
{
dem::EngineParameters bare_parameters()
{
  dem::EngineParameters p;
  p.particle.friction = p.particle.rolling_friction = 0.;
  p.particle.normal_damping = p.particle.shear_damping = 0.;
  p.wall.friction = p.wall.rolling_friction = 0.;
  p.wall.normal_damping = p.wall.shear_damping = 0.;
  p.surface = p.wall;
  p.breakage.is_active = false;
  p.geometry.wall_geometry = dem::ContactGeometry::radial;
  return p;
}

void add_sphere(dem::Engine &engine, double radius, const dem::Vec3 &position)
{
  engine.add_particle(dem::make_sphere(radius), position,
                      dem::Quaternion::Identity());
}

void advance(dem::Engine &engine, double time_step, int n_steps)
{
  for (int step = 0; step < n_steps; ++step)
    engine.advance(time_step);
}

double energy_residual(const dem::Engine &engine)
{
  const dem::EngineEnergy e = engine.energy();
  return e.work_of("planes") + e.work_of("facets") + e.gravity_work -
         e.kinetic - e.elastic - e.friction - e.rolling - e.damping -
         e.breakage - e.non_conservative_work;
}

std::vector<double> sphere_series(int order, double radius)
{
  std::vector<double> a(std::size_t(dem::n_coefficients(order)), 0.);
  a[0] = radius * std::sqrt(4. * std::numbers::pi);
  return a;
}

std::vector<double> project_nodes(int order, const std::vector<double> &values)
{
  const dem::SphereQuadrature &rule = dem::standard_quadrature();
  std::vector<double> a(std::size_t(dem::n_coefficients(order)), 0.);
  std::vector<double> y(a.size());
  for (std::size_t k = 0; k < rule.direction.size(); ++k)
  {
    dem::evaluate_harmonics(order, rule.direction[k], y);
    for (std::size_t j = 0; j < y.size(); ++j)
      a[j] += rule.weight[k] * values[k] * y[j];
  }
  return a;
}

double ellipsoid_radius(const dem::Vec3 &axes, const dem::Vec3 &s)
{
  return 1. / s.cwiseQuotient(axes).norm();
}

dem::ParticleShape body_of(std::vector<double> series)
{
  const double radius = series.front() * dem::equivalent_radius_factor;
  return dem::make_shape(
      std::make_shared<const dem::Coefficients>(std::move(series)), radius);
}
} // namespace spall::verify
