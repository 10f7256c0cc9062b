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
using Lanes = stdx::native_simd<double>;
using LaneMask = Lanes::mask_type;
using LaneVector = Triple<Lanes>;
constexpr int n_lanes = static_cast<int>(Lanes::size());

template <class Number>
inline Lanes load(const Number *column)
{
  return Lanes(column, stdx::element_aligned);
}

template <class Number>
inline void store(const Lanes &value, Number *column)
{
  value.copy_to(column, stdx::element_aligned);
}

/// A vector and a number that stand in one piece.
struct LaneQuad
{
  LaneVector vector;
  Lanes number;
};

/// Rows of `stride` numbers that the contacts of the lanes name.
template <int stride>
class LaneRows
{
public:
  LaneRows(const double *rows, const std::int32_t *index)
  {
    for (int lane = 0; lane < n_lanes; ++lane)
      row[lane] = rows + stride * static_cast<std::int64_t>(index[lane]);
  }
  Lanes number(int c) const
  {
    return Lanes([this, c](auto lane) { return row[lane][c]; });
  }
  LaneVector vector(int c) const
  {
    return {number(c), number(c + 1), number(c + 2)};
  }
  LaneQuad quad(int c) const { return {vector(c), number(c + 3)}; }

private:
  const double *row[n_lanes];
};

/// As Triple, from columns that stand in the order of the contacts.
template <class Columns>
inline LaneVector load_vector(const Columns &column, std::int64_t k)
{
  return {load(column.x + k), load(column.y + k), load(column.z + k)};
}

template <class Columns>
inline void store_vector(const LaneVector &value, const Columns &column,
                         std::int64_t k)
{
  store(value.x, column.x + k);
  store(value.y, column.y + k);
  store(value.z, column.z + k);
}

/// Some values of every lane in memory, to go through them lane by lane.
template <int n_values>
struct LaneTable
{
  alignas(64) double value[n_values][n_lanes];

  void set(int row, const Lanes &lanes)
  {
    lanes.copy_to(value[row], stdx::vector_aligned);
  }
  void set(int row, const LaneVector &vector)
  {
    set(row, vector.x);
    set(row + 1, vector.y);
    set(row + 2, vector.z);
  }
};

/// World vector as the body with the unit quaternion q sees it: q^-1 v q.
inline LaneVector to_body(const LaneQuad &q, const LaneVector &v)
{
  const LaneVector twice = Lanes(2.) * cross(v, q.vector);
  return v + q.number * twice + cross(twice, q.vector);
}
} // namespace
} // namespace dem::kernel
