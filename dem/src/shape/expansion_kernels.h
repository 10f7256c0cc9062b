#pragma once

#include "expansion_table.h"

#include <cstddef>

/// The sums of the series as they are compiled for each instruction set. Plain
/// pointers only: what is inline here would otherwise be linked from the unit
/// with the widest instructions.
namespace dem::kernel
{
/// Value and derivatives of the polynomial F(x, y, z) that equals r on the
/// sphere; F_yy = -F_xx.
enum Jet
{
  jet_value,
  jet_x,
  jet_y,
  jet_z,
  jet_xx,
  jet_xy,
  jet_xz,
  jet_yz,
  jet_zz,
  n_jet
};

/// Where a_n0 of every degree stands. The numbers up to n + 7 entries before
/// and after it are read (and multiplied by zero past n).
struct SeriesRows
{
  const double *degree[top_order + 1];
  int order;
};

/// What p_nm(z) is multiplied by. With its sums for order m go those of the
/// first derivative for m - 1 and of the second for m - 2, as q_nm' is a
/// multiple of q_n(m+1).
struct ColumnEntry
{
  double fall;               ///< of the recurrence, to p_(n+1)m
  double value[2], slope[2], ///< cosine and sine of a_nm, a_n(m-1)
      second[2];             ///< a_n(m-2)
  double unused;             ///< fills the line
};

/// The entries of n = m .. order for m = 0, then for m = 1, ...
struct Columns
{
  const ColumnEntry *entry;
  int order;
};

/// Rows of `n` numbers, a multiple of 8.
struct Directions
{
  const double *x, *y, *z;
  std::ptrdiff_t n;
};

struct Expansions
{
  /// s: three numbers; jet: n_jet numbers.
  void (*one)(const ExpansionTable &table, const SeriesRows &series,
              const double *s, double *jet);
  /// jet: n_jet rows of n numbers.
  void (*many)(const Columns &columns, const Directions &s, double *jet);
};

/// Those of the instruction set in use.
const Expansions &expansions();

namespace baseline
{
extern const Expansions expansions;
}
namespace avx2
{
extern const Expansions expansions;
}
namespace avx512
{
extern const Expansions expansions;
}
} // namespace dem::kernel
