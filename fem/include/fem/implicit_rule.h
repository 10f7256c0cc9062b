#pragma once

namespace fem
{
/// Weights of the implicit step: M a + C v + F(u) = f with a taken alpha_m, the
/// rest alpha_f of a step before its end; Newmark's beta and gamma.
struct ImplicitRule
{
  double alpha_m = 0., alpha_f = 0., beta = 0.25, gamma = 0.5;
};

/// Average acceleration: second order, unconditionally stable, no loss.
inline ImplicitRule average_acceleration()
{
  return {};
}

/// Second order, unconditionally stable, amplitude of the fastest modes times
/// `spectral_radius` in [0, 1] per step (Chung and Hulbert 1993). Throws
/// std::invalid_argument outside.
ImplicitRule generalised_alpha(double spectral_radius);
} // namespace fem
