#pragma once

#include "particle_simd.h"

/// The true surface of a particle about a contact (docs/theory/surfaces.md), in
/// lanes.
namespace dem::kernel
{
namespace
{
/// World vector that the body with the unit quaternion q calls v: q v q^-1.
SimdVector to_world(const SimdQuad &q, const SimdVector &v)
{
  const SimdVector twice = Simd(2.) * cross(q.vector, v);
  return v + q.number * twice + cross(q.vector, twice);
}

/// The surface of one side where its contact was in the last step.
struct SimdSurface
{
  SimdQuad orientation;
  SimdVector direction; ///< s, body frame
  SimdVector gradient;  ///< grad_S r, body frame
  Simd radius;
  Simd steepness;    ///< |grad (|x| - r)| = sqrt(1 + |grad_S r|^2 / r^2)
  SimdVector arm;    ///< from the centre of the particle, world
  SimdVector normal; ///< outward, world
};

SimdVector side_hessian_times(const Side &side, std::int64_t k,
                              const SimdVector &w)
{
  const Simd xy = load(side.hessian[3] + k), xz = load(side.hessian[4] + k),
             yz = load(side.hessian[5] + k);
  return {load(side.hessian[0] + k) * w.x + xy * w.y + xz * w.z,
          xy * w.x + load(side.hessian[1] + k) * w.y + yz * w.z,
          xz * w.x + yz * w.y + load(side.hessian[2] + k) * w.z};
}

/// Sides without surface data give a unit sphere.
SimdSurface locate_surface(const Side &side, std::int64_t k,
                           const ParticleSimd &particle)
{
  SimdSurface at;
  at.orientation = particle.quad(at_orientation);
  const SimdVector w = load_vector(side.offset, k);
  const SimdVector g = load_vector(side.gradient, k);
  const SimdVector bent = side_hessian_times(side, k, w);
  const Simd radius = load(side.radius + k);
  const SimdMask is_known = radius > 0.;
  SimdVector towards = load_vector(side.direction, k) + w;
  towards.z = select(is_known, towards.z, Simd(1.));
  at.direction = 1. / stdx::sqrt(dot(towards, towards)) * towards;
  at.radius =
      select(is_known, radius + dot(g, w) + 0.5 * dot(w, bent), Simd(1.));
  const SimdVector slope = g + bent;
  at.gradient = slope - dot(slope, at.direction) * at.direction;
  const SimdVector outward = at.direction - 1. / at.radius * at.gradient;
  at.steepness = stdx::sqrt(dot(outward, outward));
  at.arm = to_world(at.orientation, at.radius * at.direction);
  at.normal = to_world(at.orientation, 1. / at.steepness * outward);
  return at;
}

/// Two unit vectors across n (Duff et al. 2017).
struct SimdFrame
{
  SimdVector first, second;
};

SimdFrame across(const SimdVector &n)
{
  const Simd sign = select(n.z < 0., Simd(-1.), Simd(1.));
  const Simd a = -1. / (sign + n.z), b = n.x * n.y * a;
  return {{1. + sign * n.x * n.x * a, sign * b, -sign * n.x},
          {b, sign + n.y * n.y * a, -n.y}};
}

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

Simd dot(const SimdPlanar &u, const SimdPlanar &v)
{
  return u.x * v.x + u.y * v.y;
}

SimdPlanar in_frame(const SimdFrame &frame, const SimdVector &v)
{
  return {dot(frame.first, v), dot(frame.second, v)};
}

/// One tangent against the surface: what its second derivatives need.
struct SimdTangent
{
  SimdVector vector; ///< body frame
  Simd along, slope; ///< t.s, grad_S r.t
  SimdVector flat;   ///< t - (t.s) s
};

SimdTangent tangent_of(const SimdSurface &at, const SimdVector &world)
{
  SimdTangent t;
  t.vector = to_body(at.orientation, world);
  t.along = dot(t.vector, at.direction);
  t.slope = dot(t.vector, at.gradient);
  t.flat = t.vector - t.along * at.direction;
  return t;
}

/// The shape operator and its frame in the body.
struct SimdShapeOperator
{
  SimdMatrix matrix;
  SimdTangent first, second;
};

/// t_i.(grad grad F) t_j / |grad F| with F(x) = |x| - r(x / |x|).
SimdShapeOperator shape_operator_of(const Side &side, std::int64_t k,
                                    const SimdSurface &at,
                                    const SimdFrame &frame)
{
  SimdShapeOperator shape_operator;
  shape_operator.first = tangent_of(at, frame.first);
  shape_operator.second = tangent_of(at, frame.second);
  const SimdVector along_first =
      side_hessian_times(side, k, shape_operator.first.flat);
  const SimdVector along_second =
      side_hessian_times(side, k, shape_operator.second.flat);
  const Simd inverse = 1. / at.radius;
  const auto entry =
      [&](const SimdTangent &t, const SimdTangent &u, const SimdVector &h_t)
  {
    const Simd second =
        dot(h_t, u.flat) - t.along * u.slope - t.slope * u.along;
    return (dot(t.flat, u.flat) - inverse * second) * inverse / at.steepness;
  };
  shape_operator.matrix = {
      entry(shape_operator.first, shape_operator.first, along_first),
      entry(shape_operator.first, shape_operator.second, along_first),
      entry(shape_operator.second, shape_operator.second, along_second)};
  return shape_operator;
}

/// No step follows a contact farther than this part of the radius.
constexpr double longest_follow = 0.02;

SimdMask is_short(const SimdPlanar &step, const Simd &radius)
{
  return dot(step, step) < longest_follow * longest_follow * radius * radius;
}
} // namespace
} // namespace dem::kernel
