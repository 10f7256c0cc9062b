#pragma once

#include <dem/contact/paraboloid.h>

#include <optional>

namespace dem
{
/// The surface of a particle in the world, evaluated locally: a paraboloid,
/// rebuilt where it does not reach.
class ParticleView
{
public:
  /// `tolerance`: how far a paraboloid holds, of its height [-]; 0: always the
  /// series. The body must outlive the view.
  ParticleView(const ParticleShape &body, const Vec3 &position,
               const Mat3 &rotation, double tolerance);

  /// A paraboloid that is known already, body frame.
  void start_from(const Paraboloid &known);

  /// The surface at a unit direction of the body frame; position, normal and
  /// shape_operator in the world.
  const SurfacePoint &at(const Vec3 &direction);

  /// Direction of the body frame towards a point of the world.
  Vec3 towards(const Vec3 &point) const;
  /// A point of the body frame in the world.
  Vec3 in_world(const Vec3 &point) const { return position + rotation * point; }
  const Mat3 &orientation() const { return rotation; } ///< body to world
  const Vec3 &centre() const { return position; }      ///< in the world [m]
  const ParticleShape &shape() const { return body; }
  /// Mean radius of the particle [m].
  double size() const { return mean_size; }
  /// The series was evaluated since the last start_from().
  bool is_renewed() const { return has_renewed; }

private:
  const ParticleShape &body;
  Vec3 position;
  Mat3 rotation;
  double tolerance, mean_size;
  std::optional<Paraboloid> known;
  bool has_renewed = false;
  Vec3 last_direction = Vec3::Zero(); ///< that `last` is at
  SurfacePoint last;
};
} // namespace dem
