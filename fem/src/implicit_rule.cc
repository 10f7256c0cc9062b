#include <fem/implicit_rule.h>

#include <stdexcept>
#include <string>

namespace fem
{
ImplicitRule generalised_alpha(double spectral_radius)
{
  if (!(spectral_radius >= 0. && spectral_radius <= 1.))
    throw std::invalid_argument(
        "implicit step: spectral radius = " + std::to_string(spectral_radius) +
        ", must be from 0 to 1");
  ImplicitRule rule;
  rule.alpha_m = (2. * spectral_radius - 1.) / (spectral_radius + 1.);
  rule.alpha_f = spectral_radius / (spectral_radius + 1.);
  rule.gamma = 0.5 - rule.alpha_m + rule.alpha_f;
  rule.beta = 0.25 * (0.5 + rule.gamma) * (0.5 + rule.gamma);
  return rule;
}
} // namespace fem
