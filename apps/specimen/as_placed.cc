// Placed particles in an engine, and what of them is refused.
#include "case/digits.h"
#include "case/parameter.h"
#include "errors.h"
#include "specimen/placed_particles.h"

#include <dem/boundary/wall_clearance.h>
#include <dem/engine_boundaries.h>
#include <dem/parallel/ranks.h>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace spall
{
namespace
{
/// The deepest contact of a batch over the radius of its smaller particle.
struct Deepest
{
  double ratio = 0.;
  std::string a, b;
};

void note_overlaps(const dem::ParticleSystem &all,
                   const dem::ContactBatch &batch,
                   const std::function<std::string(std::size_t)> &other,
                   bool is_pair, const PlacedParticles &particles,
                   Deepest &deepest)
{
  for (std::size_t k = 0; k < batch.size(); ++k)
  {
    const auto a = static_cast<std::size_t>(batch.a[k]);
    double radius = all.radius(a);
    if (is_pair)
      radius =
          std::min(radius, all.radius(static_cast<std::size_t>(batch.b[k])));
    const double ratio = batch.overlap[k] / radius;
    if (ratio > deepest.ratio)
      deepest = {ratio, particles.name[static_cast<std::size_t>(all.id[a])],
                 other(k)};
  }
}

/// Of all contacts.
Deepest deepest_of(const dem::Engine &engine, const PlacedParticles &particles)
{
  const dem::ParticleSystem &all = engine.particles();
  Deepest deepest;
  note_overlaps(
      all, engine.pairs(),
      [&](std::size_t k)
      {
        const auto b = static_cast<std::size_t>(engine.pairs().b[k]);
        return particles.name[static_cast<std::size_t>(all.id[b])];
      },
      true, particles, deepest);
  for (const auto &boundary : engine.boundaries())
    note_overlaps(
        all, boundary->batch,
        [&](std::size_t k) { return boundary->name_of(k); }, false, particles,
        deepest);
  return deepest;
}

/// Names the first particle whose centre is on the other side of a closed wall.
void require_right_side(const std::string &file, const dem::Engine &engine,
                        const PlacedParticles &particles)
{
  const dem::ParticleSystem &all = engine.particles();
  for (const dem::MeshWall &wall : dem::mesh_walls(engine))
  {
    dem::WallClearance sides;
    sides.add(wall.surface);
    for (std::size_t i = 0; i < all.size(); ++i)
      if (!sides.is_clear(all.position(i), 0.))
        throw InputError(file + ": " +
                         particles.name[static_cast<std::size_t>(all.id[i])] +
                         ": is on the other side of the wall '" + wall.label +
                         "' as placed, at " + in_four_digits(all.position(i)) +
                         " m: must be on the side that Walls/" + wall.label +
                         "/particles names");
  }
}

/// Names two particles with one centre: no direction would part them.
void require_apart(const std::string &file, const PlacedParticles &particles)
{
  std::vector<std::size_t> order(particles.placement.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto at = [&](std::size_t k)
  {
    const dem::Vec3 &x = particles.placement[k].position;
    return std::array{x.x(), x.y(), x.z()};
  };
  std::ranges::sort(order, {}, at);
  const auto found = std::ranges::adjacent_find(order, {}, at);
  if (found != order.end())
    throw InputError(file + ": " + particles.name[*(found + 1)] +
                     ": has the same centre as " + particles.name[*found] +
                     ": must be another point");
}

/// Names the first particle of which all is beyond a wall.
void require_inside(const std::string &file, const dem::Engine &engine,
                    const PlacedParticles &particles)
{
  const dem::ParticleSystem &all = engine.particles();
  for (std::size_t i = 0; i < all.size(); ++i)
    for (const auto &wall : engine.boundaries())
      if (wall->beyond(all.position(i)) > all.shape[i].circumscribed_radius)
        throw InputError(file + ": " +
                         particles.name[static_cast<std::size_t>(all.id[i])] +
                         ": is beyond a wall as placed, at " +
                         in_four_digits(all.position(i)) +
                         " m: must be inside of box, container and specimen");
}
} // namespace

void add_particles(const PlacedParticles &from, dem::Engine &engine)
{
  for (std::size_t k = 0; k < from.body.size(); ++k)
    engine.add_particle(from.body[k], from.placement[k].position,
                        from.placement[k].orientation, from.material[k]);
  dem::ParticleSystem &particles = engine.particles();
  for (std::size_t row = 0; row < particles.size(); ++row)
  {
    const auto k = static_cast<std::size_t>(particles.id[row]);
    particles.velocity(row) = from.velocity[k];
    particles.spin(row) = from.spin[k];
  }
}

dem::PlacedLayer placed_layer(const PlacedParticles &from)
{
  return {from.placement, from.velocity, from.spin};
}

std::unique_ptr<dem::Engine> check_as_placed(const Case &parameters,
                                             const PlacedParticles &particles,
                                             const PlacedCheck &check)
{
  dem::EngineParameters settings = check.engine;
  settings.geometry.overlap.stop = std::numeric_limits<double>::max();
  auto engine = std::make_unique<dem::Engine>(settings, dem::one_rank());
  add_particles(particles, *engine);
  check.add_boundaries(*engine);
  engine->set_breaking(false);
  require_apart(parameters.file, particles);
  require_inside(parameters.file, *engine, particles);
  require_right_side(parameters.file, *engine, particles);
  try
  {
    engine->evaluate(1e-12);
  }
  catch (const std::runtime_error &error) // a periodic cell that is too short
  {
    throw InputError(parameters.file + ": " + check.section +
                     "/particles as placed: " + error.what());
  }
  const Deepest deepest = deepest_of(*engine, particles);
  if (deepest.ratio > check.largest_overlap)
    throw InputError(
        parameters.file + ": " + deepest.a + ": overlaps " + deepest.b +
        " by " + in_four_digits(deepest.ratio) +
        " of its radius as placed: must be at most " + check.section +
        "/largest_overlap = " + number_text(check.largest_overlap));
  return engine;
}
} // namespace spall
