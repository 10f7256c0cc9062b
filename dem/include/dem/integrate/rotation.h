#pragma once

#include <dem/triple.h>

namespace dem
{
/// A rotation as a unit quaternion, of numbers or SIMD lanes.
template <class Real>
struct Turn
{
  Triple<Real> vector;
  Real number = Real(1.);
};

/// First q, then p.
template <class Real>
DEM_SIMD_INLINE Turn<Real> operator*(const Turn<Real> &p, const Turn<Real> &q)
{
  return {p.number * q.vector + q.number * p.vector + cross(p.vector, q.vector),
          p.number * q.number - dot(p.vector, q.vector)};
}

template <class Real>
DEM_SIMD_INLINE Turn<Real> inverse(const Turn<Real> &q)
{
  return {-q.vector, q.number};
}

template <class Real>
DEM_SIMD_INLINE Triple<Real> operator*(const Turn<Real> &q,
                                       const Triple<Real> &v)
{
  const Triple<Real> twice = Real(2.) * cross(q.vector, v);
  return v + q.number * twice + cross(q.vector, twice);
}

/// Of length one again.
template <class Real>
DEM_SIMD_INLINE Turn<Real> normalised(const Turn<Real> &q)
{
  using std::sqrt;
  const Real inverse = 1. / sqrt(dot(q.vector, q.vector) + q.number * q.number);
  return {inverse * q.vector, inverse * q.number};
}

/// Cosine of half an angle and sine of half the angle over the angle.
template <class Real>
struct HalfAngle
{
  Real cosine, factor;
};

/// The series from the square of the angle [rad^2] to the power `order` of the
/// angle.
template <int order, class Real>
DEM_SIMD_INLINE HalfAngle<Real> half_angle_series(const Real &square)
{
  const Real h = 0.25 * square;
  Real cosine = Real(1.), sine = Real(1.);
  for (int n = order; n > 0; n -= 2)
  {
    cosine = 1. - (1. / (n * (n - 1))) * (h * cosine);
    sine = 1. - (1. / (n * (n + 1))) * (h * sine);
  }
  return {cosine, 0.5 * sine};
}

/// From the square of the angle [rad^2]; to round-off up to 1 rad, to 1e-10 up
/// to half a turn. What a particle turns by in a step is small: two terms are
/// exact to the last digit up to 0.01 rad.
template <class Real>
DEM_SIMD_INLINE HalfAngle<Real> half_angle(const Real &square)
{
  HalfAngle<Real> half = half_angle_series<4>(square);
  const auto is_large = square > 1e-4;
  if (any(is_large))
  {
    const HalfAngle<Real> large = half_angle_series<14>(square);
    half.cosine = select(is_large, large.cosine, half.cosine);
    half.factor = select(is_large, large.factor, half.factor);
  }
  return half;
}

/// exp(rotation vector) [rad].
template <class Real>
DEM_SIMD_INLINE Turn<Real> exponential(const Triple<Real> &rotation)
{
  const HalfAngle<Real> half = half_angle<Real>(dot(rotation, rotation));
  return {half.factor * rotation, half.cosine};
}

/// A rigid body that turns freely.
template <class Real>
struct Rotor
{
  Triple<Real> moments; ///< principal, > 0 [kg m^2]
  Turn<Real> to_world;  ///< principal frame to world
  Triple<Real> spin;    ///< world frame [rad/s]
};

/// Component d of x, y, z, counted on from z to x again.
template <int d, class Real>
DEM_SIMD_INLINE Real &component(Triple<Real> &v)
{
  if constexpr (d % 3 == 0)
    return v.x;
  else if constexpr (d % 3 == 1)
    return v.y;
  else
    return v.z;
}

/// A rotation by `angle` about principal axis d [rad]; in the body frame its
/// momentum turn back.
template <int d, class Real>
DEM_SIMD_INLINE void turn_about(const Real &angle, Triple<Real> &momentum,
                                Turn<Real> &to_world)
{
  const HalfAngle<Real> half = half_angle<Real>(angle * angle);
  const Real c = half.cosine, s = half.factor * angle;
  const Real cosine = 1. - 2. * s * s, sine = 2. * c * s;
  Real &m_e = component<d + 1>(momentum), &m_f = component<d + 2>(momentum);
  const Real along_e = m_e, along_f = m_f;
  m_e = cosine * along_e + sine * along_f;
  m_f = cosine * along_f - sine * along_e;
  Real &w = to_world.number, &q_d = component<d>(to_world.vector),
       &q_e = component<d + 1>(to_world.vector),
       &q_f = component<d + 2>(to_world.vector);
  const Real w_before = w, e_before = q_e;
  w = c * w - s * q_d;
  q_d = c * q_d + s * w_before;
  q_e = c * q_e + s * q_f;
  q_f = c * q_f - s * e_before;
}

/// Turns it without a moment over `time_step` [s]: rotations about the three
/// principal axes in turn, half ones before and after the third. Symplectic, of
/// second order; the angular momentum is kept to round-off, the energy error
/// does not grow (Touma & Wisdom 1994, Dullweber et al. 1997).
template <class Real>
DEM_SIMD_INLINE void turn_freely(Rotor<Real> &rotor, double time_step)
{
  const Triple<Real> inverse_moments{1. / rotor.moments.x, 1. / rotor.moments.y,
                                     1. / rotor.moments.z};
  Turn<Real> &q = rotor.to_world;
  Triple<Real> m = times(rotor.moments, inverse(q) * rotor.spin);
  const Triple<Real> whole = Real(time_step) * inverse_moments,
                     half = Real(0.5 * time_step) * inverse_moments;
  turn_about<0, Real>(half.x * m.x, m, q);
  turn_about<1, Real>(half.y * m.y, m, q);
  turn_about<2, Real>(whole.z * m.z, m, q);
  turn_about<1, Real>(half.y * m.y, m, q);
  turn_about<0, Real>(half.x * m.x, m, q);
  q = normalised(q);
  rotor.spin = q * times(inverse_moments, m);
}
} // namespace dem
