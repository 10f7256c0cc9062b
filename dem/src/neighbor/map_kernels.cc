// Compiled once per instruction set, with SPALL_INSTRUCTION_SET its name.
#include "map_kernels.h"

#include <experimental/simd>
#include <limits>

namespace dem::kernel
{
namespace
{
namespace stdx = std::experimental;

using Floats = stdx::native_simd<float>;
using Numbers = stdx::rebind_simd_t<std::int32_t, Floats>;
constexpr int n_floats = static_cast<int>(Floats::size());
static_assert(map_columns % n_floats == 0 && map_spare >= n_floats);

constexpr float pi = 3.14159265f;

inline Floats load(const float *from)
{
  return Floats(from, stdx::element_aligned);
}

inline Floats select(const Floats::mask_type &which, const Floats &yes,
                     const Floats &no)
{
  Floats chosen = no;
  stdx::where(which, chosen) = yes;
  return chosen;
}

int nodes_above(const MapAngles &angles, const MapView &map, const float *up,
                float lowest, std::int32_t *node, const PointRows &points)
{
  const float lowest_ratio = lowest / map.scale;
  alignas(64) float sideways[map_columns];
  for (int k = 0; k < map_columns; ++k)
    sideways[k] =
        angles.column_cosine[k] * up[0] + angles.column_sine[k] * up[1];
  int n = 0;
  for (int i = 0; i < map_rings; ++i)
  {
    const float *const ring = map.radius + (i + 1) * map_row;
    const Floats sine = angles.sine[i], along = angles.cosine[i] * up[2];
    for (int first = 0; first < map_columns; first += n_floats)
    {
      const auto is_above =
          load(ring + first) * (sine * load(sideways + first) + along) >
          lowest_ratio;
      if (stdx::none_of(is_above))
        continue;
      for (int k = first; k < first + n_floats; ++k)
      {
        if (!is_above[static_cast<std::size_t>(k - first)])
          continue;
        const float r = map.scale * ring[k], aside = r * angles.sine[i];
        node[n] = i * map_columns + k;
        points.x[n] = aside * angles.column_cosine[k];
        points.y[n] = aside * angles.column_sine[k];
        points.z[n] = r * angles.cosine[i];
        ++n;
      }
    }
  }
  return n;
}

/// The angle of (x, y) in [0, 2 pi), within 1e-5 rad (Abramowitz & Stegun
/// 4.4.49); 0 at the origin.
inline Floats angle_of(const Floats &x, const Floats &y)
{
  const Floats u = stdx::fabs(x), v = stdx::fabs(y);
  const Floats larger = stdx::max(u, v);
  const Floats t = stdx::min(u, v) / stdx::max(larger, Floats(1e-30f));
  const Floats z = t * t;
  Floats angle =
      t * (0.9998660f +
           z * (-0.3302995f +
                z * (0.1801410f + z * (-0.0851330f + z * 0.0208351f))));
  angle = select(v > u, 0.5f * pi - angle, angle);
  angle = select(x < 0.f, pi - angle, angle);
  return select(y < 0.f, 2.f * pi - angle, angle);
}

/// The radius towards a direction by bilinear interpolation, and the cosine of
/// the angle between it and the normal there.
struct Look
{
  Floats radius, cosine;
};

inline Look look_towards(const float *radius, const Floats &x, const Floats &y,
                         const Floats &z)
{
  constexpr float per_radian = map_rings / pi;
  const Floats aside = x * x + y * y;
  // Rows count from the one before the first ring.
  const Floats down = angle_of(z, stdx::sqrt(aside)) * per_radian + 0.5f;
  const Floats right = angle_of(x, y) * (map_columns / (2.f * pi));
  const auto row =
      stdx::min(stdx::static_simd_cast<Numbers>(down), Numbers(map_rings));
  const auto column = stdx::min(stdx::static_simd_cast<Numbers>(right),
                                Numbers(map_columns - 1));
  const Floats below = down - stdx::static_simd_cast<Floats>(row);
  const Floats beside = right - stdx::static_simd_cast<Floats>(column);
  const Numbers node = row * map_row + column;
  const auto corner = [&](int offset)
  { return Floats([&](auto lane) { return radius[node[lane] + offset]; }); };
  const Floats top = corner(0), bottom = corner(map_row);
  const Floats along_top = corner(1) - top,
               along_bottom = corner(map_row + 1) - bottom;
  const Floats upper = top + beside * along_top,
               lower = bottom + beside * along_bottom;
  const Floats polar = (lower - upper) * per_radian;
  const Floats azimuthal =
      (along_top + below * (along_bottom - along_top)) * per_radian;
  // Not nearer to the pole than a quarter of a step.
  constexpr float least_sine = 0.25f / per_radian;
  const Floats sine_square =
      stdx::max(aside / stdx::max(aside + z * z, Floats(1e-30f)),
                Floats(least_sine * least_sine));
  const Floats r = upper + below * (lower - upper);
  return {r, r / stdx::sqrt(r * r + polar * polar +
                            azimuthal * azimuthal / sine_square)};
}

void gaps(const MapField &field, const PointRows &points, int n, float *gap)
{
  for (int k = n; k < n + n_floats && n > 0; ++k)
  {
    points.x[k] = points.x[n - 1];
    points.y[k] = points.y[n - 1];
    points.z[k] = points.z[n - 1];
  }
  const float *const turn = field.rotation;
  for (int k = 0; k < n; k += n_floats)
  {
    const Floats x = load(points.x + k) - field.centre[0],
                 y = load(points.y + k) - field.centre[1],
                 z = load(points.z + k) - field.centre[2];
    const Floats square = x * x + y * y + z * z;
    const auto is_far = square > field.reach * field.reach;
    Floats found = std::numeric_limits<float>::infinity();
    if (!stdx::all_of(is_far))
    {
      const Look look = look_towards(field.map.radius,
                                     turn[0] * x + turn[3] * y + turn[6] * z,
                                     turn[1] * x + turn[4] * y + turn[7] * z,
                                     turn[2] * x + turn[5] * y + turn[8] * z);
      found = select(is_far, found,
                     look.cosine *
                         (stdx::sqrt(square) - field.map.scale * look.radius));
    }
    found.copy_to(gap + k, stdx::element_aligned);
  }
}
} // namespace

namespace SPALL_INSTRUCTION_SET
{
extern const MapLoops map_loops;
const MapLoops map_loops = {nodes_above, gaps};
} // namespace SPALL_INSTRUCTION_SET
} // namespace dem::kernel
