// Compiled once per instruction set, with SPALL_INSTRUCTION_SET its name.
#include "expansion_kernels.h"

#include "../simd_rows.h"

#include <bit>

namespace dem::kernel
{
namespace
{
/// (x + i y)^m stands at `group + m`; the two before m = 0 are zero.
struct Powers
{
  alignas(64) double real[group + padded_row];
  alignas(64) double imaginary[group + padded_row];
};

inline void set_product(Powers &power, int m, int a, int b)
{
  const double c = power.real[group + a], d = power.imaginary[group + a];
  const double p = power.real[group + b], q = power.imaginary[group + b];
  power.real[group + m] = c * p - d * q;
  power.imaginary[group + m] = c * q + d * p;
}

/// m = 1 .. 8 by products of products, then eight at a time.
inline void fill(Powers &power, double x, double y, int order)
{
  for (int m = -2; m <= 0; ++m)
    power.real[group + m] = power.imaginary[group + m] = 0.;
  power.real[group] = 1.;
  power.real[group + 1] = x;
  power.imaginary[group + 1] = y;
  for (int m = 2; m <= group; ++m)
    set_product(power, m, m / 2, m - m / 2);
  const Simd c = power.real[2 * group], d = power.imaginary[2 * group];
  for (int m = group; m <= order; m += n_lanes)
  {
    const Simd p = load(power.real + m), q = load(power.imaginary + m);
    store(c * p - d * q, power.real + group + m);
    store(c * q + d * p, power.imaginary + group + m);
  }
}

constexpr int reversed(int i)
{
  return n_lanes - 1 - i;
}

/// The lanes have first[0], first[-1], first[-2], ...
inline Simd load_reversed(const double *first)
{
  const SimdPack row = load_pack<n_lanes>(first - (n_lanes - 1));
  return std::bit_cast<Simd>(shuffle<n_lanes, reversed>(row, row));
}

/// p_nm, its derivative by z and half its second one, of two degrees.
struct Recurrence
{
  Simd value = 0., slope = 0., second = 0.;
  Simd value_before = 0., slope_before = 0., second_before = 0.;

  /// To the next degree; `start` is 1 at the order that begins with it.
  void step(const Simd &z, const Simd &fall, const Simd &start)
  {
    const Simd next_second = slope + z * second - fall * second_before;
    const Simd next_slope = value + z * slope - fall * slope_before;
    const Simd next_value = z * value - fall * value_before + start;
    second_before = second;
    slope_before = slope;
    value_before = value;
    second = next_second;
    slope = next_slope;
    value = next_value;
  }
};

/// Sums over the degrees, order by order: factors of cos and sin.
struct DegreeSums
{
  Simd cosine = 0., sine = 0.;

  void add(const Simd &c, const Simd &s, const Simd &by)
  {
    cosine += c * by;
    sine += s * by;
  }
};

struct OrderSums
{
  DegreeSums value, slope, second;
};

/// Of the orders m, m + 1, ... of the lanes.
inline OrderSums sum_degrees(const ExpansionTable &table,
                             const SeriesRows &series, double height, int m)
{
  const Simd z = height;
  OrderSums sums;
  Recurrence recurrence;
  for (int n = m; n <= series.order; ++n)
  {
    recurrence.step(z, load(table.fall[n] + m), load(table.first[n] + m));
    const Simd scale = load(table.scale[n] + m);
    const Simd c = scale * load(series.degree[n] + m);
    const Simd s = scale * load_reversed(series.degree[n] - m);
    sums.value.add(c, s, recurrence.value);
    sums.slope.add(c, s, recurrence.slope);
    sums.second.add(c, s, recurrence.second);
  }
  return sums;
}

/// Real part and, with the sign of a derivative by y, imaginary part of
/// f (c - i s) (p + i q).
inline Simd along(const DegreeSums &sum, const Simd &p, const Simd &q)
{
  return sum.cosine * p + sum.sine * q;
}

inline Simd across(const DegreeSums &sum, const Simd &p, const Simd &q)
{
  return sum.sine * p - sum.cosine * q;
}

using JetSimd = Simd[n_jet];

/// Derivatives by x and y lower the power of x + i y.
inline void add_orders(const ExpansionTable &table, const Powers &power,
                       const OrderSums &sums, int m, JetSimd &jet)
{
  const double *real = power.real + group + m;
  const double *imaginary = power.imaginary + group + m;
  const Simd once = load(table.m + m), twice = load(table.m_times + m);
  const Simd p = load(real), q = load(imaginary);
  const Simd p1 = once * load(real - 1), q1 = once * load(imaginary - 1);
  const Simd p2 = twice * load(real - 2), q2 = twice * load(imaginary - 2);
  jet[jet_value] += along(sums.value, p, q);
  jet[jet_x] += along(sums.value, p1, q1);
  jet[jet_y] += across(sums.value, p1, q1);
  jet[jet_z] += along(sums.slope, p, q);
  jet[jet_xx] += along(sums.value, p2, q2);
  jet[jet_xy] += across(sums.value, p2, q2);
  jet[jet_xz] += along(sums.slope, p1, q1);
  jet[jet_yz] += across(sums.slope, p1, q1);
  jet[jet_zz] += Simd(2.) * along(sums.second, p, q);
}

/// Orders are summed by their index in a group of 8, then over the 8: same
/// digits for every width.
void expand_one(const ExpansionTable &table, const SeriesRows &series,
                const double *s, double *jet)
{
  Powers power;
  fill(power, s[0], s[1], series.order);
  alignas(64) double sums[n_jet][group];
  for (int first = 0; first < group; first += n_lanes)
  {
    JetSimd lanes;
    for (Simd &sum : lanes)
      sum = 0.;
    for (int m = first; m <= series.order; m += group)
      add_orders(table, power, sum_degrees(table, series, s[2], m), m, lanes);
    for (int k = 0; k < n_jet; ++k)
      store(lanes[k], sums[k] + first);
  }
  for (int k = 0; k < n_jet; ++k)
  {
    const double *sum = sums[k];
    jet[k] = ((sum[0] + sum[4]) + (sum[2] + sum[6])) +
             ((sum[1] + sum[5]) + (sum[3] + sum[7]));
  }
}

/// (x + i y)^m and the two powers below.
struct PowerSteps
{
  Simd p[3] = {Simd(1.), Simd(0.), Simd(0.)};
  Simd q[3] = {Simd(0.), Simd(0.), Simd(0.)};

  void step(const Simd &x, const Simd &y)
  {
    p[2] = p[1];
    q[2] = q[1];
    p[1] = p[0];
    q[1] = q[0];
    p[0] = x * p[1] - y * q[1];
    q[0] = x * q[1] + y * p[1];
  }
};

/// One column of coefficients; `entry` advances to the next one.
inline OrderSums sum_column(const ColumnEntry *&entry, const Simd &z, int n)
{
  OrderSums sums;
  Simd value = 1., before = 0.;
  for (const ColumnEntry *const end = entry + n; entry != end; ++entry)
  {
    sums.value.add(entry->value[0], entry->value[1], value);
    sums.slope.add(entry->slope[0], entry->slope[1], value);
    sums.second.add(entry->second[0], entry->second[1], value);
    const Simd next = z * value - entry->fall * before;
    before = value;
    value = next;
  }
  return sums;
}

inline void add_column(const OrderSums &sums, const PowerSteps &power, int m,
                       JetSimd &jet)
{
  const Simd *p = power.p, *q = power.q;
  const Simd once = m, below = m - 1, twice = m * (m - 1);
  jet[jet_value] += along(sums.value, p[0], q[0]);
  jet[jet_x] += once * along(sums.value, p[1], q[1]);
  jet[jet_y] += once * across(sums.value, p[1], q[1]);
  jet[jet_z] += along(sums.slope, p[1], q[1]);
  jet[jet_xx] += twice * along(sums.value, p[2], q[2]);
  jet[jet_xy] += twice * across(sums.value, p[2], q[2]);
  jet[jet_xz] += below * along(sums.slope, p[2], q[2]);
  jet[jet_yz] += below * across(sums.slope, p[2], q[2]);
  jet[jet_zz] += along(sums.second, p[2], q[2]);
}

/// A direction per lane.
void expand_many(const Columns &columns, const Directions &s, double *jet)
{
  for (std::ptrdiff_t i = 0; i < s.n; i += n_lanes)
  {
    const Simd x = load(s.x + i), y = load(s.y + i), z = load(s.z + i);
    JetSimd lanes;
    for (Simd &sum : lanes)
      sum = 0.;
    const ColumnEntry *entry = columns.entry;
    PowerSteps power;
    for (int m = 0; m <= columns.order; ++m, power.step(x, y))
      add_column(sum_column(entry, z, columns.order + 1 - m), power, m, lanes);
    for (int k = 0; k < n_jet; ++k)
      store(lanes[k], jet + k * s.n + i);
  }
}
} // namespace

namespace SPALL_INSTRUCTION_SET
{
extern const Expansions expansions;
const Expansions expansions = {expand_one, expand_many};
} // namespace SPALL_INSTRUCTION_SET
} // namespace dem::kernel
