#pragma once

#include <dem/contact/law.h>

namespace dem
{
/// What one step of a range of contacts adds up to; see SumGrid.
struct RangeSum
{
  /// Load on the particle that is side A of the first contact of the range; the
  /// range before may add to it too force [N], moment [N m]. Particles that
  /// come after it in the range get theirs directly.
  double load[6] = {};
  Dissipation lost;          ///< multiples of loss_spacing
  Dissipation lost_rest;     ///< multiples of loss_rest_spacing
  double largest_force = 0.; ///< component of the force of a contact [N]
  bool wants_breakage = false;
  bool has_switched = false;  ///< patches keep factors: contacts began or ended
  bool has_displaced = false; ///< some contact is no more where it was
  int n_jumps = 0;            ///< loaded contacts that are elsewhere now
  int n_ended = 0; ///< loaded contacts that have no contact point any more
  double cell_force[3] = {}; ///< PeriodicCell::force [N]
  double overlap_ratio = 0.; ///< largest, as largest_overlap_ratio() [-]
};
} // namespace dem
