#pragma once

#include <dem/engine_boundaries.h>

#include <cmath>
#include <memory>
#include <numbers>

/// Small scenes of the particle engine for its tests.
namespace support
{
/// Springs only: no friction, damping, breakage or gravity.
inline dem::EngineParameters bare_parameters()
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

/// The same without a limit of overlaps: for scenes that put particles deep
/// into each other or through a wall.
inline dem::EngineParameters deep_parameters()
{
  dem::EngineParameters p = bare_parameters();
  p.geometry.overlap.stop = 1e9;
  return p;
}

inline void add_sphere(dem::Engine &engine, double radius,
                       const dem::Vec3 &position)
{
  engine.add_particle(dem::make_sphere(radius), position,
                      dem::Quaternion::Identity());
}

inline void advance(dem::Engine &engine, double time_step, int n_steps)
{
  for (int step = 0; step < n_steps; ++step)
    engine.advance(time_step);
}

/// A floor of the facet surface at rest that nothing can move; the corners of
/// its triangles are counter-clockwise seen from below, particles are above.
inline dem::FacetSurface
fixed_surface(std::vector<dem::Vec3> position,
              std::vector<std::array<std::int32_t, 3>> triangles)
{
  const std::size_t n = position.size();
  dem::FacetSurface surface;
  surface.triangles = std::move(triangles);
  surface.position = std::move(position);
  surface.velocity.assign(n, dem::Vec3::Zero());
  surface.mass.assign(n, std::numeric_limits<double>::infinity());
  surface.load.assign(n, dem::Vec3::Zero());
  return surface;
}

/// Triangles round the origin in the plane z = 0: four corners or more with
/// the origin as common vertex; 2: a square cut along y = x. `angle` turns the
/// first corner from the x axis [rad].
inline dem::FacetSurface coplanar_fan(int n_triangles, double size,
                                      double angle)
{
  const int n_corners = n_triangles == 2 ? 4 : n_triangles;
  std::vector<dem::Vec3> position;
  for (int c = 0; c < n_corners; ++c)
  {
    const double phi = angle + 2. * std::numbers::pi * c / n_corners;
    position.emplace_back(size * std::cos(phi), size * std::sin(phi), 0.);
  }
  if (n_triangles == 2)
    return fixed_surface(position, {{2, 1, 0}, {3, 2, 0}});
  position.push_back(dem::Vec3::Zero());
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (int c = 0; c < n_corners; ++c)
    triangles.push_back({n_corners, (c + 1) % n_corners, c});
  return fixed_surface(position, triangles);
}

/// The one touching contact of a batch; its size if there is none or more.
inline std::size_t only_nearest_point(const dem::ContactBatch &batch)
{
  std::size_t found = batch.size();
  int n = 0;
  for (std::size_t k = 0; k < batch.size(); ++k)
    if (batch.is_touching(k))
    {
      found = k;
      ++n;
    }
  return n == 1 ? found : batch.size();
}

/// Work put in less what is stored and what is lost [J].
inline double energy_residual(const dem::Engine &engine)
{
  const dem::EngineEnergy e = engine.energy();
  return e.work_of("planes") + e.work_of("facets") + e.gravity_work -
         e.kinetic - e.elastic - e.friction - e.rolling - e.damping -
         e.breakage - e.non_conservative_work;
}
} // namespace support
