#pragma once

#include <dem/triple.h>

#include <cstdint>
#include <experimental/simd>

/// Loads and stores of SIMD lanes for the units that are compiled once per
/// instruction set. Everything is internal to its unit.
namespace dem::kernel
{
namespace
{
namespace stdx = std::experimental;

/// As many numbers as the instruction set works on at once.
using Simd = stdx::native_simd<double>;
using SimdMask = Simd::mask_type;
using SimdVector = Triple<Simd>;
constexpr int n_lanes = static_cast<int>(Simd::size());

template <class Number>
inline Simd load(const Number *column)
{
  return Simd(column, stdx::element_aligned);
}

template <class Number>
inline void store(const Simd &value, Number *column)
{
  value.copy_to(column, stdx::element_aligned);
}

/// The nearest multiple of the spacing of this rounding_shift().
inline Simd on_grid(const Simd &value, double shift)
{
  return (value + shift) - shift;
}

inline SimdVector on_grid(const SimdVector &value, double shift)
{
  return {on_grid(value.x, shift), on_grid(value.y, shift),
          on_grid(value.z, shift)};
}

/// As Triple, from columns that stand in the order of the contacts.
template <class Columns>
inline SimdVector load_vector(const Columns &column, std::int64_t k)
{
  return {load(column.x + k), load(column.y + k), load(column.z + k)};
}

template <class Columns>
inline void store_vector(const SimdVector &value, const Columns &column,
                         std::int64_t k)
{
  store(value.x, column.x + k);
  store(value.y, column.y + k);
  store(value.z, column.z + k);
}

} // namespace
} // namespace dem::kernel
