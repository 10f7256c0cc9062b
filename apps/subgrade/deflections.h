#pragma once

#include "case/case.h"

#include <nlohmann/json_fwd.hpp>

#include <iosfwd>
#include <string>
#include <vector>

namespace spall
{
/// What the plate of a subgrade does in each haversine pulse, and with a disc
/// the dynamic modulus of deformation, as a light drop weight measures it (TP
/// BF-StB part B 8.3): E_vd = 1.5 r sigma / s with the radius r of the plate,
/// the largest stress sigma = F / (pi r^2) of the pulse and the deflection s.
/// With other loads there are no pulses.
class Deflections
{
public:
  explicit Deflections(const Case &parameters);

  /// The settlement of the plate at a time since loading began [m], [s].
  void note(double time, double settlement);

  bool empty() const { return pulses.empty(); }
  /// A row for each pulse: its number, deflection, the settlement that is left
  /// and, with a disc, the modulus.
  std::string table() const;
  /// Mean deflection of the last three pulses, fewer if there are fewer, and
  /// with a disc the modulus of that mean.
  void summarise(nlohmann::ordered_json &summary) const;

  void save(std::ostream &out) const;
  void restore(std::istream &in);

private:
  struct Pulse
  {
    double start = 0., largest = 0., end = 0.; ///< settlement [m]

    double deflection() const { return largest - start; } ///< [m]
  };

  double modulus(double deflection) const; ///< [Pa]

  double period = 0.;   ///< of pulse and pause; 0: the load has no pulses [s]
  std::size_t most = 0; ///< pulses
  double force = 0.;    ///< largest of a pulse [N]
  double radius = 0.;   ///< of a disc; 0: another plate [m]
  std::vector<Pulse> pulses;
};
} // namespace spall
