// Plain arrays only: what is compiled here for newer machines must not be
// shared with units that are compiled for all. Built with -ffp-contract=off,
// so that every width rounds alike.
#include "sheet_batches.h"

#include <cstring>

namespace fem
{
namespace
{
#define FEM_INLINE [[gnu::always_inline]] inline

template <int lanes>
struct Pack
{
  typedef double type __attribute__((vector_size(8 * lanes)));
};

template <typename Simd>
FEM_INLINE void load(Simd &to, const double *from)
{
  std::memcpy(&to, from, sizeof(Simd));
}

template <typename Simd>
FEM_INLINE void add(double *to, const Simd &change)
{
  Simd value;
  std::memcpy(&value, to, sizeof(Simd));
  value += change;
  std::memcpy(to, &value, sizeof(Simd));
}

template <typename Simd>
FEM_INLINE void dot(Simd &sum, const Simd *a, const Simd *b)
{
  sum = (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}

/// f[a] = sum_v x_v dN_v/dX_a
template <typename Simd>
FEM_INLINE void tangents(const SheetBatch &batch,
                         const BatchPositions &positions, int q, int lane,
                         Simd (*f)[3])
{
  for (int v = 0; v < 4; ++v)
    for (int a = 0; a < 2; ++a)
    {
      Simd slope;
      load(slope, &batch.gradient[q][v][a][lane]);
      for (int i = 0; i < 3; ++i)
      {
        Simd position;
        load(position, &positions.x[v][i][lane]);
        if (v == 0)
          f[a][i] = slope * position;
        else
          f[a][i] += slope * position;
      }
    }
}

template <typename Simd>
struct Stress
{
  Simd xx, yy, xy, energy;
};

/// St Venant-Kirchhoff in plane stress, from C = F^T F.
template <typename Simd>
FEM_INLINE void kirchhoff(const BatchLaw &law, const Simd &cxx, const Simd &cyy,
                          const Simd &cxy, Stress<Simd> &s)
{
  const Simd exx = 0.5 * (cxx - 1.);
  const Simd eyy = 0.5 * (cyy - 1.);
  const Simd exy = 0.5 * cxy;
  s.xx = law.stiffness * (exx + law.poisson_ratio * eyy);
  s.yy = law.stiffness * (eyy + law.poisson_ratio * exx);
  s.xy = law.stiffness * (1. - law.poisson_ratio) * exy;
  s.energy = 0.5 * (s.xx * exx + s.yy * eyy + 2. * (s.xy * exy));
}

/// Incompressible: S = mu h (1 - adj(C) / det(C)^2).
template <typename Simd>
FEM_INLINE void neo_hooke(const BatchLaw &law, const Simd &cxx, const Simd &cyy,
                          const Simd &cxy, Stress<Simd> &s)
{
  const Simd thinning = 1. / (cxx * cyy - cxy * cxy);
  const Simd squared = thinning * thinning;
  s.xx = law.shear * (1. - cyy * squared);
  s.yy = law.shear * (1. - cxx * squared);
  s.xy = law.shear * cxy * squared;
  s.energy = 0.5 * law.shear * ((cxx + cyy) + (thinning - 3.));
}

template <typename Simd>
FEM_INLINE void root(Simd &to, const Simd &from)
{
  for (std::size_t k = 0; k < sizeof(Simd) / sizeof(double); ++k)
    to[k] = __builtin_sqrt(from[k]);
}

/// Stress and energy along the wrinkles at C1, see TensionLine.
template <typename Simd>
FEM_INLINE void along_wrinkles(const TensionLine &line, const Simd &major,
                               Simd &stress, Simd &energy)
{
  const Simd c = major > line.slack ? major : major * 0. + line.slack;
  if (line.is_neo_hookean)
  {
    Simd ratio{};
    root(ratio, line.start / c);
    stress = line.modulus * (line.start - ratio / c);
    energy = 0.5 * line.modulus * ((line.start * c + 2. * ratio) - 3.);
  }
  else
  {
    const Simd e = 0.5 * (c - 1.);
    stress = line.modulus * e + line.start;
    energy = (0.5 * line.modulus * e + line.start) * e;
  }
  energy += line.energy;
}

/// No compression: S_r and W_r in place of those of the law.
template <typename Simd>
FEM_INLINE void relax(const BatchLaw &law, const Simd &cxx, const Simd &cyy,
                      const Simd &cxy, Stress<Simd> &s)
{
  const Simd half = 0.5 * (cxx - cyy), apart = 0.5 * (s.xx - s.yy);
  Simd radius{}, spread{}, stress, energy;
  root(radius, half * half + cxy * cxy);
  root(spread, apart * apart + s.xy * s.xy);
  along_wrinkles(law.line, 0.5 * (cxx + cyy) + radius, stress, energy);
  // Where both are zero the stress is, too.
  radius = radius > 1e-300 ? radius : radius * 0. + 1e-300;
  const auto is_taut = 0.5 * (s.xx + s.yy) - spread > 0.;
  const double r = law.residual;
  const Simd share = (0.5 * (1. - r)) * stress;
  const Simd cosine = half / radius, sine = cxy / radius;
  s.xx = is_taut ? s.xx : share * (1. + cosine) + r * s.xx;
  s.yy = is_taut ? s.yy : share * (1. - cosine) + r * s.yy;
  s.xy = is_taut ? s.xy : share * sine + r * s.xy;
  s.energy = is_taut ? s.energy : (1. - r) * energy + r * s.energy;
}

/// flux[b] = w S_ab F_a; returns the energy in `energy`.
template <typename Simd>
FEM_INLINE void fluxes(const BatchLaw &law, const Simd &weight,
                       const Simd (*f)[3], Simd (*flux)[3], Simd &energy)
{
  Simd cxx, cyy, cxy;
  dot(cxx, f[0], f[0]);
  dot(cyy, f[1], f[1]);
  dot(cxy, f[0], f[1]);
  Stress<Simd> s;
  if (law.is_neo_hookean)
    neo_hooke(law, cxx, cyy, cxy, s);
  else
    kirchhoff(law, cxx, cyy, cxy, s);
  s.xx += law.tension;
  s.yy += law.tension;
  s.energy += 0.5 * law.tension * ((cxx + cyy) - 2.);
  if (law.has_wrinkles)
    relax(law, cxx, cyy, cxy, s);
  energy = weight * s.energy;
  for (int i = 0; i < 3; ++i)
  {
    flux[0][i] = weight * (s.xx * f[0][i] + s.xy * f[1][i]);
    flux[1][i] = weight * (s.xy * f[0][i] + s.yy * f[1][i]);
  }
}

/// Adds the share of one point to the forces of `lanes` elements.
template <typename Simd>
FEM_INLINE void point_forces(const SheetBatch &batch, const BatchLaw &law,
                             const BatchPositions &positions, int q, int lane,
                             BatchForces &out)
{
  Simd f[2][3], flux[2][3], normal[3], weight, energy;
  load(weight, &batch.weight[q][lane]);
  tangents(batch, positions, q, lane, f);
  fluxes(law, weight, f, flux, energy);
  add(&out.energy[lane], energy);
  for (int i = 0; i < 3; ++i)
  {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    normal[i] = weight * (f[0][j] * f[1][k] - f[0][k] * f[1][j]);
  }
  for (int v = 0; v < 4; ++v)
  {
    Simd first, second;
    load(first, &batch.gradient[q][v][0][lane]);
    load(second, &batch.gradient[q][v][1][lane]);
    for (int i = 0; i < 3; ++i)
    {
      const Simd internal = -(first * flux[0][i] + second * flux[1][i]);
      const Simd area = law.value[q][v] * normal[i];
      add(&out.internal[v][i][lane], internal);
      add(&out.area[v][i][lane], area);
    }
  }
}

template <int lanes>
FEM_INLINE void batch_forces(const SheetBatch &batch, const BatchLaw &law,
                             const BatchPositions &positions, BatchForces &out)
{
  std::memset(&out, 0, sizeof(out));
  for (int lane = 0; lane < batch_size; lane += lanes)
    for (int q = 0; q < 4; ++q)
      point_forces<typename Pack<lanes>::type>(batch, law, positions, q, lane,
                                               out);
}

void two_lanes(const SheetBatch &batch, const BatchLaw &law,
               const BatchPositions &positions, BatchForces &out)
{
  batch_forces<2>(batch, law, positions, out);
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void four_lanes(const SheetBatch &batch,
                                        const BatchLaw &law,
                                        const BatchPositions &positions,
                                        BatchForces &out)
{
  batch_forces<4>(batch, law, positions, out);
}

[[gnu::target("avx512f")]] void eight_lanes(const SheetBatch &batch,
                                            const BatchLaw &law,
                                            const BatchPositions &positions,
                                            BatchForces &out)
{
  batch_forces<8>(batch, law, positions, out);
}
#endif
} // namespace

std::vector<BatchKernel> batch_kernels()
{
  std::vector<BatchKernel> kernels;
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f"))
    kernels.push_back(eight_lanes);
  if (__builtin_cpu_supports("avx2"))
    kernels.push_back(four_lanes);
#endif
  kernels.push_back(two_lanes);
  return kernels;
}
} // namespace fem
