#include "membrane_motion.h"

#include <istream>
#include <ostream>
#include <stdexcept>

namespace fem
{
namespace
{
constexpr std::uint64_t magic = 0x33304d454d4c5053; // "SPLMEM03"

/// The same list of fields for writing and reading.
template <typename Motion, typename Field>
void for_each_field(Motion &motion, const Field &field)
{
  const std::size_t n = motion.position.size();
  field(motion.position.data(), n);
  field(motion.velocity.data(), n);
  field(motion.acceleration.data(), n);
  field(&motion.has_acceleration, std::size_t{1});
  field(motion.moved.data(), n);
  field(motion.load.data(), n);
  field(motion.tied.data(), n);
  field(motion.forces.internal.data(), n);
  field(motion.forces.area.data(), n);
  field(&motion.forces.strain_energy, std::size_t{1});
  field(&motion.pressure, std::size_t{1});
  field(&motion.done, std::size_t{1});
}

template <typename Value>
std::uint64_t hash(std::uint64_t seed, const Value *values, std::size_t n)
{
  const auto *byte = reinterpret_cast<const unsigned char *>(values);
  for (std::size_t k = 0; k < n * sizeof(Value); ++k)
    seed = (seed ^ byte[k]) * 0x100000001b3;
  return seed;
}

MembraneMotion empty_motion(std::size_t n)
{
  const std::vector<Eigen::Vector3d> zeros(n, Eigen::Vector3d::Zero());
  MembraneMotion motion;
  motion.position = motion.velocity = motion.moved = motion.load = zeros;
  motion.acceleration = zeros;
  motion.forces.internal = motion.forces.area = zeros;
  motion.tied.assign(n, 0);
  return motion;
}
} // namespace

void save_motion(std::ostream &out, std::uint64_t fingerprint,
                 const MembraneMotion &motion)
{
  const auto write = [&out](const auto *values, std::size_t n)
  {
    out.write(reinterpret_cast<const char *>(values),
              static_cast<std::streamsize>(n * sizeof(*values)));
  };
  write(&magic, 1);
  write(&fingerprint, 1);
  for_each_field(motion, write);
  if (!out)
    throw std::runtime_error("membrane checkpoint: cannot write");
}

MembraneMotion load_motion(std::istream &in, std::uint64_t fingerprint,
                           std::size_t n_nodes)
{
  const auto read = [&in](auto *values, std::size_t n)
  {
    if (!in.read(reinterpret_cast<char *>(values),
                 static_cast<std::streamsize>(n * sizeof(*values))))
      throw std::runtime_error("membrane checkpoint: the file ends too early");
  };
  std::uint64_t found_magic = 0, found_fingerprint = 0;
  read(&found_magic, 1);
  if (found_magic != magic)
    throw std::runtime_error("membrane checkpoint: this is no membrane state");
  read(&found_fingerprint, 1);
  if (found_fingerprint != fingerprint)
    throw std::runtime_error("membrane checkpoint: it belongs to a membrane "
                             "with another mesh or other parameters");
  MembraneMotion motion = empty_motion(n_nodes);
  for_each_field(motion, read);
  return motion;
}

std::uint64_t fingerprint(const MembraneParameters &parameters,
                          const SurfaceMesh &mesh)
{
  std::uint64_t seed = 0xcbf29ce484222325;
  seed = hash(seed, &parameters, 1);
  seed = hash(seed, mesh.nodes.data(), mesh.nodes.size());
  seed = hash(seed, mesh.quads.data(), mesh.quads.size());
  return hash(seed, mesh.midpoints.data(), mesh.midpoints.size());
}
} // namespace fem
