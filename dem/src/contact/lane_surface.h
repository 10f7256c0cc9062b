#pragma once

#include "contact_lanes.h"

/// The true surface of a stone about a contact, and the Newton step to the
/// common normal of two (docs/theory/surfaces.md), in lanes.
namespace dem::kernel
{
namespace
{
/// World vector that the body with the unit quaternion q calls v: q v q^-1.
LaneVector to_world(const LaneQuad &q, const LaneVector &v)
{
  const LaneVector twice = Lanes(2.) * cross(q.vector, v);
  return v + q.number * twice + cross(q.vector, twice);
}

/// The surface of one side where its contact was in the last step.
struct LaneSurface
{
  LaneQuad orientation;
  LaneVector direction; ///< s, body frame
  LaneVector gradient;  ///< grad_S r, body frame
  Lanes radius;
  Lanes steepness;   ///< |grad (|x| - r)| = sqrt(1 + |grad_S r|^2 / r^2)
  LaneVector arm;    ///< from the centre of the stone, world
  LaneVector normal; ///< outward, world
};

LaneVector side_hessian_times(const Side &side, std::int64_t k,
                              const LaneVector &w)
{
  const Lanes xy = load(side.hessian[3] + k), xz = load(side.hessian[4] + k),
              yz = load(side.hessian[5] + k);
  return {load(side.hessian[0] + k) * w.x + xy * w.y + xz * w.z,
          xy * w.x + load(side.hessian[1] + k) * w.y + yz * w.z,
          xz * w.x + yz * w.y + load(side.hessian[2] + k) * w.z};
}

/// Sides that know no surface give a unit sphere.
LaneSurface locate_surface(const Side &side, std::int64_t k,
                           const StoneLanes &stone)
{
  LaneSurface at;
  at.orientation = stone.quad(at_orientation);
  const LaneVector w = load_vector(side.offset, k);
  const LaneVector g = load_vector(side.gradient, k);
  const LaneVector bent = side_hessian_times(side, k, w);
  const Lanes radius = load(side.radius + k);
  const LaneMask is_known = radius > 0.;
  LaneVector towards = load_vector(side.direction, k) + w;
  towards.z = select(is_known, towards.z, Lanes(1.));
  at.direction = 1. / stdx::sqrt(dot(towards, towards)) * towards;
  at.radius =
      select(is_known, radius + dot(g, w) + 0.5 * dot(w, bent), Lanes(1.));
  const LaneVector slope = g + bent;
  at.gradient = slope - dot(slope, at.direction) * at.direction;
  const LaneVector outward = at.direction - 1. / at.radius * at.gradient;
  at.steepness = stdx::sqrt(dot(outward, outward));
  at.arm = to_world(at.orientation, at.radius * at.direction);
  at.normal = to_world(at.orientation, 1. / at.steepness * outward);
  return at;
}

/// Two unit vectors across n (Duff et al. 2017).
struct LaneFrame
{
  LaneVector first, second;
};

LaneFrame across(const LaneVector &n)
{
  const Lanes sign = select(n.z < 0., Lanes(-1.), Lanes(1.));
  const Lanes a = -1. / (sign + n.z), b = n.x * n.y * a;
  return {{1. + sign * n.x * n.x * a, sign * b, -sign * n.x},
          {b, sign + n.y * n.y * a, -n.y}};
}

/// A symmetric matrix in a frame of two tangents.
struct LaneMatrix
{
  Lanes xx, xy, yy;

  Lanes determinant() const { return xx * yy - xy * xy; }
};

/// A vector in that frame.
struct LanePlanar
{
  Lanes x, y;
};

LanePlanar operator*(const LaneMatrix &m, const LanePlanar &v)
{
  return {m.xx * v.x + m.xy * v.y, m.xy * v.x + m.yy * v.y};
}

/// None in the other lanes.
LanePlanar only(const LaneMask &mask, const LanePlanar &v)
{
  return {select(mask, v.x, Lanes(0.)), select(mask, v.y, Lanes(0.))};
}

Lanes dot(const LanePlanar &u, const LanePlanar &v)
{
  return u.x * v.x + u.y * v.y;
}

LanePlanar in_frame(const LaneFrame &frame, const LaneVector &v)
{
  return {dot(frame.first, v), dot(frame.second, v)};
}

/// One tangent against the surface: what its second derivatives need.
struct LaneTangent
{
  LaneVector vector;  ///< body frame
  Lanes along, slope; ///< t.s, grad_S r.t
  LaneVector flat;    ///< t - (t.s) s
};

LaneTangent tangent_of(const LaneSurface &at, const LaneVector &world)
{
  LaneTangent t;
  t.vector = to_body(at.orientation, world);
  t.along = dot(t.vector, at.direction);
  t.slope = dot(t.vector, at.gradient);
  t.flat = t.vector - t.along * at.direction;
  return t;
}

/// The shape operator and its frame in the body.
struct LaneBend
{
  LaneMatrix matrix;
  LaneTangent first, second;
};

/// t_i.(grad grad F) t_j / |grad F| with F(x) = |x| - r(x / |x|).
LaneBend bend_of(const Side &side, std::int64_t k, const LaneSurface &at,
                 const LaneFrame &frame)
{
  LaneBend bend;
  bend.first = tangent_of(at, frame.first);
  bend.second = tangent_of(at, frame.second);
  const LaneVector along_first = side_hessian_times(side, k, bend.first.flat);
  const LaneVector along_second = side_hessian_times(side, k, bend.second.flat);
  const Lanes inverse = 1. / at.radius;
  const auto entry =
      [&](const LaneTangent &t, const LaneTangent &u, const LaneVector &h_t)
  {
    const Lanes second =
        dot(h_t, u.flat) - t.along * u.slope - t.slope * u.along;
    return (dot(t.flat, u.flat) - inverse * second) * inverse / at.steepness;
  };
  bend.matrix = {entry(bend.first, bend.first, along_first),
                 entry(bend.first, bend.second, along_first),
                 entry(bend.second, bend.second, along_second)};
  return bend;
}

/// Where the Newton step of a set of lanes leads.
struct LaneStep
{
  LanePlanar on_a, on_b;
  Lanes overlap;     ///< there, to second order; < 0: a gap
  LaneMask is_sound; ///< K_A + K_B is positive and the step is short
};

/// No step follows a contact farther than this part of the radius.
constexpr double longest_follow = 0.02;

LaneMask is_short(const LanePlanar &step, const Lanes &radius)
{
  return dot(step, step) < longest_follow * longest_follow * radius * radius;
}

/// Solves (K_A + K_B - delta K_B K_A) a = -m - K_B t, as newton_step() does.
LaneStep step_to_normal(const LaneBend &a, const LaneBend &b,
                        const LanePlanar &t, const LanePlanar &m,
                        const Lanes &overlap)
{
  const LaneMatrix &ka = a.matrix, &kb = b.matrix;
  const LaneMatrix lens{ka.xx + kb.xx, ka.xy + kb.xy, ka.yy + kb.yy};
  const LanePlanar kb_t = kb * t;
  const LanePlanar right{-m.x - kb_t.x, -m.y - kb_t.y};
  // K_B K_A is not symmetric.
  const Lanes xx = lens.xx - overlap * (kb.xx * ka.xx + kb.xy * ka.xy);
  const Lanes xy = lens.xy - overlap * (kb.xx * ka.xy + kb.xy * ka.yy);
  const Lanes yx = lens.xy - overlap * (kb.xy * ka.xx + kb.yy * ka.xy);
  const Lanes yy = lens.yy - overlap * (kb.xy * ka.xy + kb.yy * ka.yy);
  const Lanes determinant = xx * yy - xy * yx;
  LaneStep step;
  step.is_sound = lens.xx > 0. && lens.determinant() > 0. && determinant > 0.;
  const Lanes inverse = 1. / select(step.is_sound, determinant, Lanes(1.));
  step.on_a = {inverse * (yy * right.x - xy * right.y),
               inverse * (xx * right.y - yx * right.x)};
  const LanePlanar ka_a = ka * step.on_a;
  step.on_b = {step.on_a.x - overlap * ka_a.x + t.x,
               step.on_a.y - overlap * ka_a.y + t.y};
  const LanePlanar aside{step.on_a.x + t.x, step.on_a.y + t.y};
  step.overlap = overlap - 0.5 * dot(step.on_a, ka_a) - dot(m, aside) -
                 0.5 * dot(aside, kb * aside);
  return step;
}

} // namespace
} // namespace dem::kernel
