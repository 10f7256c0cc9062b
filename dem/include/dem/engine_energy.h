#pragma once

#include <map>
#include <string>

namespace dem
{
/// Energy of the particles now, and what has passed since construction [J].
struct EngineEnergy
{
  double kinetic = 0.;  ///< now
  double elastic = 0.;  ///< now, all springs of all contacts
  double friction = 0.; ///< dissipated
  double rolling = 0.;  ///< dissipated
  double damping = 0.;  ///< dissipated by dashpots and local damping
  double breakage = 0.; ///< released by events, lost kinetic energy included
  double non_conservative_work = 0.; ///< springs gained (negative) by turning
  double fracture = 0.;              ///< sum of G_c A_i over the events
  /// Done by the boundaries on the particles, by kind.
  std::map<std::string, double> boundary_work;
  double cell_work = 0.; ///< done by the periodic cell on the particles
  double gravity_work = 0.;

  /// Work of the boundaries of one kind; 0 if there is none [J].
  double work_of(const std::string &kind) const
  {
    const auto found = boundary_work.find(kind);
    return found == boundary_work.end() ? 0. : found->second;
  }
};

/// Wall-clock spent in the phases of a step since construction [s].
struct EngineClock
{
  double contacts = 0., search = 0., breakage = 0., motion = 0.;
  double exchange = 0.; ///< with other ranks, in every step
};
} // namespace dem
