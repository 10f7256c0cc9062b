#pragma once

#include <dem/breakage/criterion.h>
#include <dem/shape/particle_shape.h>
#include <dem/shape/quadrature.h>

namespace dem
{
/// What one event removes and where.
struct Spall
{
  Vec3 direction = Vec3::UnitZ(); ///< u_i, unit, body frame [-]
  double volume = 0.;             ///< V_i to remove [m^3]
  double overlap = 0.;            ///< delta [m]
  double gaussian_curvature =
      0.; ///< K_G of the particle there, floored [1/m^2]
};

/// The particle after the event, with what was done.
struct SpallResult
{
  ParticleShape body;
  double width = 0.;          ///< lambda [rad]
  double depth = 0.;          ///< theta [m]
  double removed_volume = 0.; ///< before minus after, by quadrature [m^3]
  bool is_accepted = false;   ///< false: the shape would lose r > 0; unchanged
};

/// How wide and how deep the kernel is.
struct KernelRule
{
  double floor = 2.5; ///< c_lambda [-]
  double scale = 1.;  ///< s [-]
  DepthClosure closure = DepthClosure::exact;
  InscribedSphereAt inscribed = InscribedSphereAt::origin;
};

/// Angular width of the Gaussian kernel: max(lambda_patch, c_lambda / N_s),
/// lambda_patch = s sqrt(delta / sqrt(K_G)) / r_c, at most pi / 4 [rad]
/// (docs/theory/breakage.md, The new shape).
double kernel_width(const Spall &spall, double contact_radius, int order,
                    const KernelRule &rule);

/// k_n = 2 pi int exp(-gamma^2 / 2 lambda^2) P_n(cos gamma) sin gamma d gamma,
/// n = 0 .. order: the exact projection of the zonal kernel (Funk-Hecke) [-].
std::vector<double> kernel_spectrum(double width, int order);

/// Closure exact: subtract theta K from r so that the volume drops by exactly
/// V_i, theta by Newton on the nodes of the rule. Closure article:
/// theta = V_i / (r_0^2 int K), the mean taken out of the kernel, and the mean
/// radius r_0 lowered by Eqs. 17, 18; the volume that leaves is then another
/// one, see `removed_volume`. The series becomes the particle's own.
SpallResult apply_spall(const ParticleShape &body, const Spall &spall,
                        const KernelRule &shape,
                        const SphereQuadrature &rule = standard_quadrature());
} // namespace dem
