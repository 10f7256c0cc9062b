#pragma once

#include "dem_scene.h"

#include <coupling/exchange.h>
#include <coupling/rigid_body.h>

#include <memory>
#include <sstream>

/// Small scenes of particles and bodies together.
namespace support
{
/// n x n quads on the square of this side round (0, 0, z), outside is +z.
inline fem::SurfaceMesh square_at(double side, double z, int n = 1)
{
  fem::SurfaceMesh mesh;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      mesh.nodes.emplace_back(side * (double(i) / n - 0.5),
                              side * (double(j) / n - 0.5), z);
  for (std::int32_t j = 0; j < n; ++j)
    for (std::int32_t i = 0; i < n; ++i)
    {
      const std::int32_t low = j * (n + 1) + i, high = low + n + 1;
      mesh.quads.push_back({low, low + 1, high + 1, high});
    }
  return mesh;
}

/// A pressure on the top of a block of 0.4 by 0.4 m from the origin, 2 by 2
/// cells, as loads of its nodes [N].
inline coupling::Field pressed(const coupling::DeformableBody &body,
                               double pressure)
{
  coupling::Field load;
  for (const dem::Vec3 &at : body.motion().position)
  {
    double area = 0.2 * 0.2;
    for (int c = 0; c < 2; ++c)
      if (std::abs(at[c] - 0.2) > 0.1) // a rim
        area *= 0.5;
    load.emplace_back(0., 0., -pressure * area);
  }
  return load;
}

/// A plate that moves along z only.
inline fem::PlateBodyParameters upright(double mass)
{
  fem::PlateBodyParameters p;
  p.mass = mass;
  p.moves = {false, false, true};
  p.turns = {false, false, false};
  return p;
}

inline const coupling::ShapeLibrary &no_shapes()
{
  static const coupling::ShapeLibrary none;
  return none;
}

/// Particles and one body that they fall on.
struct SphereOnBody
{
  SphereOnBody(const dem::EngineParameters &parameters,
               const coupling::ExchangeParameters &rules, double its_step)
      : step(its_step), engine(parameters), exchange(rules)
  {
  }

  static dem::EngineParameters falling_on(double stiffness)
  {
    dem::EngineParameters p = bare_parameters();
    p.gravity = {0., 0., -9.81};
    p.surface.normal_stiffness = stiffness;
    p.surface.normal_damping = 0.2;
    return p;
  }

  void run(double duration)
  {
    const auto particles = coupling::particles_of(engine, no_shapes());
    for (int k = 0; k * step < duration; ++k)
      exchange.advance(particles, step);
  }

  double height() const { return engine.particles().position(0).z(); }

  double step; ///< [s]
  dem::Engine engine;
  coupling::Exchange exchange;
  const coupling::DeformableBody *body = nullptr;
};

inline std::string saved(const dem::Engine &engine)
{
  std::ostringstream out(std::ios::binary);
  engine.save(out, no_shapes());
  return out.str();
}

/// Momentum of all particles [N s].
inline dem::Vec3 momentum(const dem::Engine &engine)
{
  dem::Vec3 sum = dem::Vec3::Zero();
  for (std::size_t i = 0; i < engine.particles().size(); ++i)
    sum += engine.particles().mass(i) * engine.particles().velocity(i);
  return sum;
}

/// What a body has got less what it has and lost [J].
inline double missing(const coupling::DeformableBody &body)
{
  const coupling::BodyEnergy e = body.energy();
  return e.external + e.load_work - e.stored - e.kinetic - e.lost;
}

/// Of the whole scene: what came from outside less what is there and lost [J].
inline double
residual(const dem::Engine &engine,
         std::initializer_list<const coupling::DeformableBody *> bodies)
{
  // The particles' own balance counts the work of the surfaces as given.
  double sum = energy_residual(engine);
  for (const coupling::DeformableBody *body : bodies)
    sum += missing(*body);
  return sum;
}
} // namespace support
