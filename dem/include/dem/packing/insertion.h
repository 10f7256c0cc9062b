#pragma once

#include <dem/random.h>
#include <dem/shape/particle_shape.h>

#include <functional>
#include <span>
#include <stdexcept>
#include <vector>

namespace dem
{
/// Initial position and orientation of a particle.
struct Placement
{
  Vec3 position = Vec3::Zero(); ///< [m]
  Quaternion orientation = Quaternion::Identity();
};

/// Where particles may lie.
struct InsertionBox
{
  Vec3 lower = Vec3::Zero(), upper = Vec3::Ones(); ///< [m]
  /// No overlap of the true surfaces either, nor of the circumscribed spheres
  /// with a face.
  bool sees_surfaces = false;
  /// Only the upright cylinder in the middle of the box, as wide as it is.
  bool is_round = false;
  /// Whether a sphere of this radius about a point is clear of what else is
  /// there, as walls; empty: all are.
  std::function<bool(const Vec3 &, double)> is_clear = {};
};

/// There is no free position in a box for a particle.
class NoFreePosition : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// Random sequential insertion of the particles, in their order, into the box
/// without overlap along any branch line or towards any face.
/// Throws NoFreePosition if a particle finds none in 20 000 tries.
std::vector<Placement>
insert_particles(std::span<const ParticleShape> particles,
                 const InsertionBox &box, Random &random);
} // namespace dem
