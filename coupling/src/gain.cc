#include <coupling/gain.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace coupling
{
namespace
{
void require(bool condition, const std::string &what, double value,
             const std::string &allowed)
{
  if (!condition)
    throw std::invalid_argument("exchange gain: " + what + " = " +
                                std::to_string(value) + ", " + allowed);
}

void check(const ExchangeContact &contact, std::span<const double> nodal_mass,
           double membrane_step, double time_step)
{
  require(std::isfinite(contact.stiffness) && contact.stiffness >= 0.,
          "stiffness", contact.stiffness, "must not be negative");
  require(std::isfinite(contact.damping_ratio) && contact.damping_ratio >= 0.,
          "damping ratio", contact.damping_ratio, "must not be negative");
  require(contact.particle_mass > 0., "particle mass", contact.particle_mass,
          "must be positive");
  require(membrane_step > 0., "membrane step", membrane_step,
          "must be positive");
  require(std::isfinite(time_step) && time_step > 0., "time step", time_step,
          "must be positive");
  for (const double mass : nodal_mass)
    require(mass > 0., "nodal mass", mass, "must be positive");
}
} // namespace

ExchangeGain exchange_gain(const ExchangeContact &contact,
                           std::span<const double> nodal_mass,
                           double membrane_step, double time_step)
{
  check(contact, nodal_mass, membrane_step, time_step);
  double over_mass = 1. / contact.particle_mass;
  if (!nodal_mass.empty())
    over_mass += 1. / *std::min_element(nodal_mass.begin(), nodal_mass.end());
  const double membrane_frequency = 2. / membrane_step;
  const double beta = contact.damping_ratio;
  ExchangeGain result;
  result.gain =
      0.25 * time_step * time_step *
      (membrane_frequency * membrane_frequency + contact.stiffness * over_mass);
  result.limit = std::pow(std::sqrt(1. + beta * beta) - beta, 2);
  return result;
}

WindowGain window_gain(const ExchangeContact &contact, double nodal_mass,
                       double window)
{
  check(contact, {&nodal_mass, 1}, 1., window);
  const double beta = contact.damping_ratio;
  WindowGain result;
  result.gain = 0.25 * window * window * contact.stiffness / nodal_mass;
  // Both are the smaller root of a quadratic in sqrt(gain).
  result.one_pass_limit =
      std::pow((std::sqrt(16. * beta * beta + 3.) - 4. * beta) / 3., 2);
  result.unrelaxed_limit = std::pow(std::sqrt(1. + beta * beta) - beta, 2);
  result.best_relaxation =
      1. / (1. + result.gain + 2. * beta * std::sqrt(result.gain));
  return result;
}
} // namespace coupling
