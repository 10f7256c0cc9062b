#pragma once

#include <dem/engine.h>
#include <dem/shape/quadrature.h>

namespace spall::verify
{
/// Springs only: no friction, damping, breakage or gravity; walls meet the
/// local radii.
dem::EngineParameters bare_parameters();

void add_sphere(dem::Engine &engine, double radius, const dem::Vec3 &position);
void advance(dem::Engine &engine, double time_step, int n_steps);

/// Work put in less what is stored and what is lost [J].
double energy_residual(const dem::Engine &engine);

/// A series that is `radius` everywhere [m].
std::vector<double> sphere_series(int order, double radius);

/// Least squares on the 40 x 80 rule of a radius [m] given at unit directions.
template <class Radius>
std::vector<double> project(int order, const Radius &radius);

/// The same from values at the nodes of the rule.
std::vector<double> project_nodes(int order, const std::vector<double> &values);

template <class Radius>
std::vector<double> project(int order, const Radius &radius)
{
  std::vector<double> values;
  for (const dem::Vec3 &s : dem::standard_quadrature().direction)
    values.push_back(radius(s));
  return project_nodes(order, values);
}

/// r of an ellipsoid at the unit direction s [m].
double ellipsoid_radius(const dem::Vec3 &axes, const dem::Vec3 &s);

/// A particle with exactly this series, at the origin of its frame.
dem::ParticleShape body_of(std::vector<double> series);
} // namespace spall::verify
