#pragma once

/// Constants of the polynomials that expand() works with. Plain numbers only:
/// units of every instruction set read them.
namespace dem::kernel
{
/// max_order of the series [-].
inline constexpr int top_order = 30;

/// Orders m = 0 .. top_order in groups of 8, whatever the instruction set.
inline constexpr int group = 8;
inline constexpr int padded_row = (top_order / group + 1) * group;

/// q_nm = scale_nm p_nm with p_mm = 1 and p_nm = z p_(n-1)m - fall_nm
/// p_(n-2)m: the recurrence of ZonalTable without its first factor. Row n has
/// m = 0 .. n, then zeros.
struct ExpansionTable
{
  alignas(64) double scale[top_order + 1][padded_row] = {};
  alignas(64) double fall[top_order + 1][padded_row] = {};
  alignas(
      64) double first[top_order + 1][padded_row] = {}; ///< p_mm: 1 at n = m
  alignas(64) double m[padded_row] = {};                ///< m
  alignas(64) double m_times[padded_row] = {};          ///< m (m - 1)
};

/// The table, made once.
const ExpansionTable &expansion_table();
} // namespace dem::kernel
