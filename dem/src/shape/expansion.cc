#include "expansion_kernels.h"
#include "zonal_table.h"

#include <dem/assert.h>
#include <dem/instruction_set.h>
#include <dem/shape/spherical_harmonics.h>

#include <algorithm>
#include <array>

namespace dem
{
namespace
{
/// The kernels read up to this many numbers beside a degree of the series.
constexpr std::size_t margin = kernel::group;

/// The first degrees and the last one again, with numbers beside them.
struct SeriesEnds
{
  std::array<double, 2 * margin + n_coefficients(2)> head;
  std::array<double, 2 * margin + 2 * max_order + 1> tail;
};

/// Zeros, the numbers, zeros; returns where the numbers begin.
double *enclose(std::span<const double> numbers, double *out)
{
  std::fill_n(out, margin, 0.);
  std::copy(numbers.begin(), numbers.end(), out + margin);
  std::fill_n(out + margin + numbers.size(), margin, 0.);
  return out + margin;
}

kernel::SeriesRows rows_of(std::span<const double> coefficients,
                           SeriesEnds &ends)
{
  kernel::SeriesRows series;
  const int order = order_of(coefficients.size());
  DEM_ASSERT(order >= 0);
  series.order = order;
  for (int n = 3; n < order; ++n)
    series.degree[n] = coefficients.data() + harmonic_index(n, 0);
  const double *last =
      enclose(coefficients.last(std::size_t(2 * order + 1)), ends.tail.data());
  series.degree[order] = last + order;
  const int n_head = std::min(order, 2);
  const double *first =
      enclose(coefficients.first(std::size_t(n_coefficients(n_head))),
              ends.head.data());
  for (int n = 0; n <= n_head; ++n)
    series.degree[n] = first + harmonic_index(n, 0);
  return series;
}

using Jet = std::array<double, kernel::n_jet>;

Jet jet_at(std::span<const double> coefficients, const Vec3 &s)
{
  SeriesEnds ends;
  const kernel::SeriesRows series = rows_of(coefficients, ends);
  Jet jet;
  kernel::expansions().one(kernel::expansion_table(), series, s.data(),
                           jet.data());
  return jet;
}

/// Every coefficient of both signs, or none below order zero.
void set_pair(std::span<const double> coefficients, int n, int m, double factor,
              double (&pair)[2])
{
  pair[0] =
      m < 0 ? 0. : factor * coefficients[std::size_t(harmonic_index(n, m))];
  pair[1] =
      m < 0 ? 0. : factor * coefficients[std::size_t(harmonic_index(n, -m))];
}

std::vector<kernel::ColumnEntry>
columns_of(std::span<const double> coefficients, int order)
{
  const kernel::ExpansionTable &table = kernel::expansion_table();
  const detail::ZonalTable &zonal = detail::zonal_table();
  std::vector<kernel::ColumnEntry> entries;
  entries.reserve(coefficients.size());
  for (int m = 0; m <= order; ++m)
    for (int n = m; n <= order; ++n)
    {
      kernel::ColumnEntry entry = {};
      const double scale = table.scale[n][m];
      entry.fall = n < max_order ? table.fall[n + 1][m] : 0.;
      set_pair(coefficients, n, m, scale, entry.value);
      if (m >= 1)
        set_pair(coefficients, n, m - 1, scale * zonal.slope[n][m - 1],
                 entry.slope);
      if (m >= 2)
        set_pair(coefficients, n, m - 2, scale * zonal.slope2[n][m - 2],
                 entry.second);
      entries.push_back(entry);
    }
  return entries;
}

// The sum of q_nm(z) (x + i y)^m is a polynomial F of x, y, z that equals r on
// the sphere. For any such extension grad_S r = P_t grad F and
// H = P_t (grad grad F - (s . grad F) I) P_t.
RadialExpansion on_the_sphere(const Vec3 &s, const double *jet,
                              std::ptrdiff_t stride)
{
  const auto of = [&](kernel::Jet entry) { return jet[entry * stride]; };
  const Vec3 slope(of(kernel::jet_x), of(kernel::jet_y), of(kernel::jet_z));
  const double outward = s.dot(slope);
  Mat3 second;
  second << of(kernel::jet_xx), of(kernel::jet_xy), of(kernel::jet_xz),
      of(kernel::jet_xy), -of(kernel::jet_xx), of(kernel::jet_yz),
      of(kernel::jet_xz), of(kernel::jet_yz), of(kernel::jet_zz);
  // P_t B P_t = B - s (B s)^T - (B s) s^T + (s B s) s s^T, half of it at a time
  const Vec3 across = second * s;
  const Vec3 half = across - 0.5 * (s.dot(across) + outward) * s;
  RadialExpansion expansion;
  expansion.direction = s;
  expansion.radius = of(kernel::jet_value);
  expansion.gradient = slope - outward * s;
  expansion.hessian = second - s * half.transpose() - half * s.transpose() -
                      outward * Mat3::Identity();
  return expansion;
}

/// Directions that are worked on at once: their jets stay in the cache.
constexpr std::size_t chunk = 64;

struct ChunkRows
{
  alignas(64) double s[3][chunk];
  alignas(64) double jet[kernel::n_jet * chunk];
};
} // namespace

const kernel::Expansions &kernel::expansions()
{
  const InstructionSet set = instruction_set();
  return set == InstructionSet::avx512 ? avx512::expansions
         : set == InstructionSet::avx2 ? avx2::expansions
                                       : baseline::expansions;
}

double radius(std::span<const double> coefficients, const Vec3 &s)
{
  return jet_at(coefficients, s)[kernel::jet_value];
}

RadialExpansion expand(std::span<const double> coefficients, const Vec3 &s)
{
  return on_the_sphere(s, jet_at(coefficients, s).data(), 1);
}

void expand(std::span<const double> coefficients, std::span<const Vec3> s,
            std::span<RadialExpansion> expansions)
{
  DEM_ASSERT(s.size() == expansions.size());
  const int order = order_of(coefficients.size());
  DEM_ASSERT(order >= 0);
  const std::vector<kernel::ColumnEntry> entries =
      columns_of(coefficients, order);
  ChunkRows rows;
  for (std::size_t first = 0; first < s.size(); first += chunk)
  {
    const std::size_t n = std::min(chunk, s.size() - first);
    const std::size_t n_padded =
        (n + kernel::group - 1) / kernel::group * kernel::group;
    for (std::size_t k = 0; k < n_padded; ++k)
      for (int axis = 0; axis < 3; ++axis)
        rows.s[axis][k] = s[first + std::min(k, n - 1)][axis];
    kernel::expansions().many(
        {entries.data(), order},
        {rows.s[0], rows.s[1], rows.s[2], std::ptrdiff_t(n_padded)}, rows.jet);
    for (std::size_t k = 0; k < n; ++k)
      expansions[first + k] =
          on_the_sphere(s[first + k], rows.jet + k, std::ptrdiff_t(n_padded));
  }
}
} // namespace dem
