#pragma once

#include "simd.h"

#include <bit>
#include <utility>

/// Rows of numbers, one for each lane, into lanes and back: four numbers of
/// every row at a time, with half the instructions of number by number.
/// Internal to the units that are compiled once per instruction set.
namespace dem::kernel
{
namespace
{
template <int n>
struct PackOf
{
  typedef double type __attribute__((vector_size(8 * n)));
};
/// Numbers side by side in a register.
template <int n>
using Pack = typename PackOf<n>::type;

template <int n>
DEM_SIMD_INLINE Pack<n> load_pack(const double *from)
{
  Pack<n> pack;
  __builtin_memcpy(&pack, from, sizeof pack);
  return pack;
}

template <class Numbers>
DEM_SIMD_INLINE void store_pack(const Numbers &pack, double *to)
{
  __builtin_memcpy(to, &pack, sizeof pack);
}

using SimdPack = Pack<n_lanes>;

/// Entry i is entry from(i) of two packs, counted through both.
template <int n, int (*from)(int), class Part>
DEM_SIMD_INLINE Pack<n> shuffle(const Part &first, const Part &second)
{
  return [&]<int... i>(std::integer_sequence<int, i...>)
      __attribute__((always_inline))
  {
    return __builtin_shufflevector(first, second, from(i)...);
  }
  (std::make_integer_sequence<int, n>());
}

constexpr int in_turn(int i)
{
  return i;
}
/// Every second number of both in turn.
constexpr int even(int i)
{
  return i % 2 == 0 ? i : n_lanes + i - 1;
}
constexpr int odd(int i)
{
  return i % 2 == 0 ? i + 1 : n_lanes + i;
}
constexpr int upper_four(int i)
{
  return i + 4;
}
/// Two of every four numbers of both in turn.
constexpr int lower(int i)
{
  return i % 4 < 2 ? i : n_lanes + i - 2;
}
constexpr int upper(int i)
{
  return i % 4 < 2 ? i + 2 : n_lanes + i;
}

/// Four numbers of every lane, in four registers: number by number, or row by
/// row as load_rows() finds them. transpose() turns the one into the other.
struct FourPacks
{
  SimdPack pack[4];
};

DEM_SIMD_INLINE FourPacks transpose(const FourPacks &by)
{
  const SimdPack a = shuffle<n_lanes, even>(by.pack[0], by.pack[1]),
                 b = shuffle<n_lanes, odd>(by.pack[0], by.pack[1]),
                 c = shuffle<n_lanes, even>(by.pack[2], by.pack[3]),
                 d = shuffle<n_lanes, odd>(by.pack[2], by.pack[3]);
  if constexpr (n_lanes == 2)
    return {a, b, c, d};
  else
    return {shuffle<n_lanes, lower>(a, c), shuffle<n_lanes, lower>(b, d),
            shuffle<n_lanes, upper>(a, c), shuffle<n_lanes, upper>(b, d)};
}

/// Pack j has rows j and j + 4, row j, or half of row j % 2, as lanes are 8, 4
/// or 2.
template <class RowOf>
DEM_SIMD_INLINE FourPacks load_rows(const RowOf &row)
{
  FourPacks rows;
  for (int j = 0; j < 4; ++j)
    if constexpr (n_lanes == 8)
      rows.pack[j] =
          shuffle<8, in_turn>(load_pack<4>(row(j)), load_pack<4>(row(j + 4)));
    else if constexpr (n_lanes == 4)
      rows.pack[j] = load_pack<4>(row(j));
    else
      rows.pack[j] = load_pack<2>(row(j % 2) + 2 * (j / 2));
  return rows;
}

template <class RowOf>
DEM_SIMD_INLINE void store_rows(const FourPacks &rows, const RowOf &row)
{
  for (int j = 0; j < 4; ++j)
    if constexpr (n_lanes == 8)
    {
      store_pack(shuffle<4, in_turn>(rows.pack[j], rows.pack[j]), row(j));
      store_pack(shuffle<4, upper_four>(rows.pack[j], rows.pack[j]),
                 row(j + 4));
    }
    else if constexpr (n_lanes == 4)
      store_pack(rows.pack[j], row(j));
    else
      store_pack(rows.pack[j], row(j % 2) + 2 * (j / 2));
}

/// A vector and a number that stand in one piece.
struct SimdQuad
{
  SimdVector vector;
  Simd number = Simd(0.);
};

/// Number by number, as packs.
DEM_SIMD_INLINE FourPacks packs(const SimdQuad &quad)
{
  return {std::bit_cast<SimdPack>(quad.vector.x),
          std::bit_cast<SimdPack>(quad.vector.y),
          std::bit_cast<SimdPack>(quad.vector.z),
          std::bit_cast<SimdPack>(quad.number)};
}

/// Rows of `stride` numbers that an index names for every lane.
template <int stride, class Number = const double>
class SimdRows
{
public:
  template <class Index>
  SimdRows(Number *rows, const Index &index)
  {
    for (int lane = 0; lane < n_lanes; ++lane)
      row[lane] = rows + stride * static_cast<std::int64_t>(index[lane]);
  }
  /// Numbers c to c + 3.
  DEM_SIMD_INLINE SimdQuad quad(int c) const
  {
    const FourPacks by =
        transpose(load_rows([this, c](int lane) { return row[lane] + c; }));
    return {{std::bit_cast<Simd>(by.pack[0]), std::bit_cast<Simd>(by.pack[1]),
             std::bit_cast<Simd>(by.pack[2])},
            std::bit_cast<Simd>(by.pack[3])};
  }
  /// Numbers c to c + 2; there is one more in the row.
  SimdVector vector(int c) const { return quad(c).vector; }

  /// Writes them.
  void set(int c, const SimdQuad &quad) const
  {
    store_rows(transpose(packs(quad)),
               [this, c](int lane) { return row[lane] + c; });
  }

private:
  Number *row[n_lanes];
};

/// Some values of every lane in memory, a row for each lane, to go through them
/// lane by lane.
template <int n_values>
struct SimdTable
{
  static_assert(n_values % 4 == 0);
  alignas(64) double value[n_lanes][n_values];

  /// Values c to c + 3.
  DEM_SIMD_INLINE void set(int c, const SimdQuad &quad)
  {
    store_rows(transpose(packs(quad)),
               [this, c](int lane) { return value[lane] + c; });
  }
};

/// World vector in the frame of the body with the unit quaternion q: q^-1 v q.
inline SimdVector to_body(const SimdQuad &q, const SimdVector &v)
{
  const SimdVector twice = Simd(2.) * cross(v, q.vector);
  return v + q.number * twice + cross(twice, q.vector);
}
} // namespace
} // namespace dem::kernel
