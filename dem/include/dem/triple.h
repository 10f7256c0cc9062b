#pragma once

#include <cmath>
#include <type_traits>

/// Functions over lanes must never be calls: their arguments fill registers.
#define DEM_SIMD_INLINE [[gnu::always_inline]] inline

namespace dem
{
/// A vector whose components are numbers or SIMD lanes of numbers, so that one
/// law serves both.
template <class Real>
struct Triple
{
  Real x = Real(0.), y = Real(0.), z = Real(0.);

  [[gnu::always_inline]] Triple &operator+=(const Triple &v)
  {
    x += v.x;
    y += v.y;
    z += v.z;
    return *this;
  }
};

template <class Real>
DEM_SIMD_INLINE Triple<Real> operator+(const Triple<Real> &u,
                                       const Triple<Real> &v)
{
  return {u.x + v.x, u.y + v.y, u.z + v.z};
}

template <class Real>
DEM_SIMD_INLINE Triple<Real> operator-(const Triple<Real> &u,
                                       const Triple<Real> &v)
{
  return {u.x - v.x, u.y - v.y, u.z - v.z};
}

template <class Real>
DEM_SIMD_INLINE Triple<Real> operator-(const Triple<Real> &v)
{
  return {-v.x, -v.y, -v.z};
}

template <class Real>
DEM_SIMD_INLINE Triple<Real> operator*(const std::type_identity_t<Real> &s,
                                       const Triple<Real> &v)
{
  return {s * v.x, s * v.y, s * v.z};
}

template <class Real>
DEM_SIMD_INLINE Real dot(const Triple<Real> &u, const Triple<Real> &v)
{
  return u.x * v.x + u.y * v.y + u.z * v.z;
}

template <class Real>
DEM_SIMD_INLINE Triple<Real> cross(const Triple<Real> &u, const Triple<Real> &v)
{
  return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}

/// Component by component.
template <class Real>
DEM_SIMD_INLINE Triple<Real> times(const Triple<Real> &u, const Triple<Real> &v)
{
  return {u.x * v.x, u.y * v.y, u.z * v.z};
}

/// `yes` where the condition holds, else `no`, lane by lane.
template <class Mask, class Real>
DEM_SIMD_INLINE Real select(const Mask &condition,
                            const std::type_identity_t<Real> &yes, Real no)
{
  if constexpr (std::is_same_v<Mask, bool>)
    return condition ? yes : no;
  else
  {
    where(condition, no) = yes;
    return no;
  }
}

/// Whether the condition holds in any lane.
template <class Mask>
DEM_SIMD_INLINE bool any(const Mask &condition)
{
  if constexpr (std::is_same_v<Mask, bool>)
    return condition;
  else
    return any_of(condition);
}
} // namespace dem
