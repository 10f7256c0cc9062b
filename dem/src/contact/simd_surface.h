#pragma once

#include "particle_simd.h"

/// The true surface of a particle about a contact (docs/theory/surfaces.md), in
/// lanes: its osculating paraboloid.
namespace dem::kernel
{
namespace
{
/// A symmetric matrix in a frame of two tangents.
struct SimdMatrix
{
  Simd xx, xy, yy;

  Simd determinant() const { return xx * yy - xy * xy; }
};

/// A vector in that frame.
struct SimdPlanar
{
  Simd x, y;
};

SimdPlanar operator*(const SimdMatrix &m, const SimdPlanar &v)
{
  return {m.xx * v.x + m.xy * v.y, m.xy * v.x + m.yy * v.y};
}

SimdPlanar operator+(const SimdPlanar &u, const SimdPlanar &v)
{
  return {u.x + v.x, u.y + v.y};
}

Simd dot(const SimdPlanar &u, const SimdPlanar &v)
{
  return u.x * v.x + u.y * v.y;
}

/// As PlanarColumn.
template <class Columns>
SimdPlanar load_planar(const Columns &column, std::int64_t k)
{
  return {load(column.x + k), load(column.y + k)};
}

/// Two tangents of a surface.
struct SimdFrame
{
  SimdVector first, second;

  SimdVector in_world(const SimdPlanar &v) const
  {
    return v.x * first + v.y * second;
  }
};

SimdPlanar in_frame(const SimdFrame &frame, const SimdVector &v)
{
  return {dot(frame.first, v), dot(frame.second, v)};
}

/// World axes of the body with a unit quaternion.
struct SimdRotation
{
  SimdVector x, y, z;

  explicit SimdRotation(const SimdQuad &q)
  {
    const SimdVector &v = q.vector;
    const SimdVector twice = v + v;
    const Simd xx = v.x * twice.x, xy = v.x * twice.y, xz = v.x * twice.z,
               yy = v.y * twice.y, yz = v.y * twice.z, zz = v.z * twice.z;
    const SimdVector w = q.number * twice;
    x = {1. - (yy + zz), xy + w.z, xz - w.y};
    y = {xy - w.z, 1. - (xx + zz), yz + w.x};
    z = {xz + w.y, yz - w.x, 1. - (xx + yy)};
  }
  SimdVector operator*(const SimdVector &v) const
  {
    return v.x * x + v.y * y + v.z * z;
  }
};

/// The surface of one side about its contact: x(w) = p + F w - (w.K w / 2) n,
/// with an unscaled normal n + F K w. World, from the centre of the particle.
struct SimdSurface
{
  SimdFrame frame;           ///< F
  SimdVector axis;           ///< n
  SimdMatrix shape_operator; ///< K
  SimdPlanar offset;         ///< w of the contact in the last step
  SimdPlanar turn;           ///< K w
  Simd height;               ///< of p along n; 0: nothing is known
  SimdVector arm;            ///< x(w)

  /// 1 / |n + F K w|, by its series.
  Simd inverse_length() const
  {
    const Simd square = dot(turn, turn);
    return 1. - square * (0.5 - square * (0.375 - 0.3125 * square));
  }
  SimdVector outward() const { return axis + frame.in_world(turn); }
  /// Components of v along n + F K w, and across it where v is along it nearly:
  /// zero where v is parallel to it.
  Simd along(const SimdPlanar &in_frame, const Simd &on_axis) const
  {
    return on_axis + dot(turn, in_frame);
  }
  SimdPlanar across(const SimdPlanar &in_frame, const Simd &on_axis) const
  {
    return {in_frame.x - on_axis * turn.x, in_frame.y - on_axis * turn.y};
  }
};

/// Axes of surface_axes() in the world. Sides without surface data have any.
SimdFrame surface_frame(const SimdRotation &rotation, const SimdVector &n)
{
  const Simd sign = select(n.z < 0., Simd(-1.), Simd(1.));
  const Simd a = -1. / (sign + n.z), b = n.x * n.y * a;
  const Simd signed_x = sign * n.x;
  return {rotation * SimdVector{1. + signed_x * n.x * a, sign * b, -signed_x},
          rotation * SimdVector{b, sign + n.y * n.y * a, -n.y}};
}

SimdSurface locate_surface(const Side &side, std::int64_t k,
                           const ParticleSimd &particle)
{
  SimdSurface at;
  at.frame = surface_frame(SimdRotation(particle.quad(at_orientation)),
                           load_vector(side.normal, k));
  at.axis = cross(at.frame.first, at.frame.second);
  at.shape_operator = {load(side.shape_operator[0] + k),
                       load(side.shape_operator[1] + k),
                       load(side.shape_operator[2] + k)};
  at.offset = load_planar(side.offset, k);
  at.turn = at.shape_operator * at.offset;
  at.height = load(side.height + k);
  at.arm = at.frame.in_world(load_planar(side.aside, k) + at.offset) +
           (at.height - 0.5 * dot(at.offset, at.turn)) * at.axis;
  return at;
}

/// Notes where the contact is now; the sides that are farther from the vertex
/// than this part of its height are stale.
SimdMask move_on_surface(const Side &side, std::int64_t k,
                         const SimdSurface &before, const SimdPlanar &step,
                         const SimdMask &is_followed, double tolerance)
{
  const SimdPlanar moved = before.offset + step;
  const SimdPlanar kept{select(is_followed, moved.x, before.offset.x),
                        select(is_followed, moved.y, before.offset.y)};
  store(kept.x, side.offset.x + k);
  store(kept.y, side.offset.y + k);
  const Simd reach = tolerance * before.height;
  return is_followed && dot(kept, kept) > reach * reach;
}

/// No step follows a contact farther than this part of the height.
constexpr double longest_follow = 0.02;

SimdMask is_short(const SimdPlanar &step, const Simd &height)
{
  return dot(step, step) < longest_follow * longest_follow * height * height;
}
} // namespace
} // namespace dem::kernel
