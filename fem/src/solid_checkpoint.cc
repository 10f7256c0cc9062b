#include "solid_state.h"

#include <algorithm>
#include <istream>
#include <ostream>
#include <stdexcept>

namespace fem
{
namespace
{
constexpr std::uint64_t magic = 0x3230444c534c5053; // "SPLSLD02"

/// The same list of fields for writing and reading.
template <typename Motion, typename Field>
void for_each_field(Motion &now, const Field &field)
{
  for (auto *nodes :
       {&now.displacement, &now.velocity, &now.acceleration, &now.moved,
        &now.load, &now.elastic, &now.viscous, &now.support_velocity,
        &now.support_displacement, &now.relief})
    field(nodes->data(), nodes->size());
  for (auto *points : {&now.plastic.strain, &now.plastic.stress})
    field(points->data(), points->size());
  field(&now.done, std::size_t{1});
  field(&now.has_acceleration, std::size_t{1});
}

template <typename Value>
std::uint64_t hash(std::uint64_t seed, const Value *values, std::size_t n)
{
  const auto *byte = reinterpret_cast<const unsigned char *>(values);
  for (std::size_t k = 0; k < n * sizeof(Value); ++k)
    seed = (seed ^ byte[k]) * 0x100000001b3;
  return seed;
}
} // namespace

/// Mesh, materials and which components are fixed or absorbing.
std::uint64_t Solid::State::fingerprint() const
{
  if (identity)
    return *identity;
  std::uint64_t seed = 0xcbf29ce484222325;
  seed = hash(seed, parameters.layers.data(), parameters.layers.size());
  seed = hash(seed, &parameters.mass_damping, 1);
  seed = hash(seed, &parameters.stiffness_damping, 1);
  seed = hash(seed, mesh.nodes.data(), mesh.nodes.size());
  seed = hash(seed, mesh.cells.data(), mesh.cells.size());
  seed = hash(seed, mesh.layer.data(), mesh.layer.size());
  seed = hash(seed, bedding.data(), bedding.size());
  identity = hash(seed, dashpot.data(), dashpot.size());
  return *identity;
}

void Solid::save(std::ostream &out) const
{
  const auto write = [&out](const auto *values, std::size_t n)
  {
    out.write(reinterpret_cast<const char *>(values),
              static_cast<std::streamsize>(n * sizeof(*values)));
  };
  const std::uint64_t identity = state->fingerprint();
  write(&magic, 1);
  write(&identity, 1);
  for_each_field(state->now, write);
  const std::span<const Voigt> initial = state->plastic.initial_stress();
  write(initial.data(), initial.size());
  if (!out)
    throw std::runtime_error("solid checkpoint: cannot write");
}

void Solid::load(std::istream &in)
{
  const auto read = [&in](auto *values, std::size_t n)
  {
    if (!in.read(reinterpret_cast<char *>(values),
                 static_cast<std::streamsize>(n * sizeof(*values))))
      throw std::runtime_error("solid checkpoint: the file ends too early");
  };
  std::uint64_t found = 0;
  read(&found, 1);
  if (found != magic)
    throw std::runtime_error("solid checkpoint: this is no solid state");
  read(&found, 1);
  if (found != state->fingerprint())
    throw std::runtime_error("solid checkpoint: it belongs to a body with "
                             "another mesh, supports or parameters");
  SolidMotion motion = state->now;
  for_each_field(motion, read);
  std::vector<Voigt> initial(state->plastic.initial_stress().size());
  read(initial.data(), initial.size());
  std::ranges::copy(initial, state->plastic.initial_stress().begin());
  state->now = std::move(motion);
}
} // namespace fem
