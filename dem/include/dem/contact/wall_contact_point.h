#pragma once

#include <dem/contact/particle_view.h>

#include <array>
#include <cstdint>

namespace dem
{
/// A contact point of a particle and a wall, or nearly one: the point of the
/// wall that is deepest in the particle among its neighbours. A point y of the
/// wall is D(y) = (x - y).n deep, x being the point of the particle next to it
/// with the outward normal n. D is smooth, whatever the wall is made of: on a
/// face it is greatest where n is the normal of the face, on an edge where n is
/// across it, at a vertex where the depth grows along no edge. Its greatest
/// value does not jump when the contact point goes from one feature to the
/// next, and changes by the velocity of the points of contact along n.
struct WallContactPoint
{
  Vec3 on_particle = Vec3::UnitZ(); ///< unit direction in the body frame [-]
  Vec3 point = Vec3::Zero();        ///< y, on the wall [m]
  Vec3 normal = Vec3::UnitZ();      ///< n, from the particle to the wall [-]
  double overlap = 0.;              ///< D(y), > 0 where they overlap [m]
  std::int32_t triangle = -1;       ///< that holds y, on facets
  std::array<double, 3> weight{};   ///< of its corners [-]
  bool is_found = false;            ///< the search has converged
};

/// How deep a point of the world is in a particle, near `on_particle`; finds
/// the other fields but those of the wall.
WallContactPoint depth_of(ParticleView &particle, const Vec3 &point,
                          const Vec3 &on_particle);

/// Two normals within 45 degrees are of one patch of a wall.
bool is_one_patch(const Vec3 &normal, const Vec3 &other);
} // namespace dem
