#pragma once

#include <limits>
#include <span>

namespace coupling
{
/// Stability of the explicit exchange of motion and load at a light node.
struct ExchangeGain
{
  double gain = 0.; ///< k dt^2 / (4 m*) at the lightest node [-]
  /// Largest stable value with the damping in use; infinite: any [-].
  double limit = 1.;
  bool is_stable() const { return gain < limit; }
};

struct ExchangeContact
{
  double stiffness = 0.;     ///< k of one contact [N/m]
  double damping_ratio = 0.; ///< beta of its dashpot [-]
  /// Of the lightest particle; infinite: its motion does not matter [kg].
  double particle_mass = std::numeric_limits<double>::infinity();
};

/// gain = (omega_m^2 + k / m*) dt^2 / 4 with omega_m = 2 / `membrane_step` of
/// the membrane alone and 1 / m* = 1 / m + 1 / `particle_mass`, m the lightest
/// of `nodal_mass`, the nodes that move freely [kg]; limit = (sqrt(1 + beta^2)
/// - beta)^2: central differences with a lagged dashpot c = 2 beta sqrt(k m*).
/// Exact for one node and one particle without membrane; with it on the safe
/// side, as long as one contact loads the node. Throws std::invalid_argument.
ExchangeGain exchange_gain(const ExchangeContact &contact,
                           std::span<const double> nodal_mass,
                           double membrane_step, double time_step);

/// Of one contact on the lightest node through a window, the particle moving as
/// it likes: gain = k T^2 / (4 m). A pass answers a motion d of the node by
/// -(gain + 2 beta sqrt(gain)) d.
struct WindowGain
{
  double gain = 0.; ///< [-]
  /// One pass: 3 gain + 8 beta sqrt(gain) < 1; sharp without damping [-].
  double one_pass_limit = 1. / 3.;
  /// Passes without relaxation converge below; sharp: gain + 2 beta sqrt(gain)
  /// < 1 [-].
  double unrelaxed_limit = 1.;
  double best_relaxation = 1.; ///< 1 / (1 + gain + 2 beta sqrt(gain)) [-]
};

/// Throws std::invalid_argument.
WindowGain window_gain(const ExchangeContact &contact, double nodal_mass,
                       double window);
} // namespace coupling
