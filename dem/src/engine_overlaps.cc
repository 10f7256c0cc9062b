// How deep the contacts of the engine are, and when that is too deep.

#include "engine_state.h"

#include <cstdio>
#include <string>

namespace dem
{
namespace
{
/// A contact of one of the batches.
struct DeepContact
{
  const ContactBatch *batch = nullptr;
  std::size_t number = 0;
  double ratio = 0.; ///< overlap over radius [-]
  std::string wall;  ///< of a contact with a wall
};

DeepContact deepest_of(const ContactBatch &batch,
                       const ParticleSystem &particles)
{
  DeepContact deepest{&batch, 0, 0., {}};
  for (std::size_t k = 0; k < batch.size(); ++k)
    if (const double ratio = overlap_ratio(batch, particles, k);
        batch.is_touching(k) && ratio > deepest.ratio)
      deepest = {&batch, k, ratio, {}};
  return deepest;
}

std::string particle_name(const ParticleSystem &particles, std::size_t i)
{
  char text[80];
  std::snprintf(text, sizeof text, "particle %d (%.3g g, radius %.3g mm)",
                static_cast<int>(particles.id[i]), 1e3 * particles.mass(i),
                1e3 * particles.radius(i));
  return text;
}

std::string describe(const DeepContact &contact,
                     const ParticleSystem &particles)
{
  const ContactBatch &batch = *contact.batch;
  const auto a = static_cast<std::size_t>(batch.a[contact.number]);
  double radius = particles.radius(a);
  std::string other = contact.wall;
  if (batch.layout.has_partners)
  {
    const auto b = static_cast<std::size_t>(batch.b[contact.number]);
    radius = std::min(radius, particles.radius(b));
    other = particle_name(particles, b);
  }
  const Vec3 &at = particles.position(a);
  char text[200];
  std::snprintf(text, sizeof text,
                " overlap by %.3g mm at (%.4g, %.4g, %.4g) m, %.3g of the %s",
                1e3 * contact.ratio * radius, at.x(), at.y(), at.z(),
                contact.ratio,
                batch.layout.has_partners ? "smaller radius" : "radius");
  return particle_name(particles, a) + " and " + other + text;
}
} // namespace

void EngineState::note_overlap(double ratio)
{
  overlap.note(ratio);
  if (!keeps_inside || ratio <= settings.geometry.overlap.stop)
    return;
  fault = deepest_contact();
  if (!distribution.is_shared())
    throw OverlapStop(fault); // else where ranks meet next
}

std::string EngineState::deepest_contact() const
{
  DeepContact deepest = deepest_of(pair_batch, system);
  for (const auto &boundary : walls)
  {
    const DeepContact other = deepest_of(boundary->batch, system);
    if (other.ratio <= deepest.ratio)
      continue;
    deepest = other;
    deepest.wall = boundary->name_of(other.number);
  }
  return describe(deepest, system);
}
} // namespace dem
