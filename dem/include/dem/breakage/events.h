#pragma once

#include <dem/boundary/boundary.h>
#include <dem/breakage/criterion.h>
#include <dem/contact/forces.h>

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace dem
{
/// One breakage event, as booked.
struct BreakageEvent
{
  double time = 0.;           ///< [s]
  std::int64_t particle = -1; ///< id of the particle that broke
  std::int64_t other = -1; ///< id of the other particle, plane, surface, or -1
  int kind = 0;            ///< 0 particle, else Boundary::event_kind()
  BreakageMode mode = BreakageMode::none;
  double force_before = 0.;      ///< elastic normal [N]
  double force_after = 0.;       ///< [N]
  double overlap = 0.;           ///< before [m]
  double elastic_energy = 0.;    ///< E_e of the contact before [J]
  double fracture_energy = 0.;   ///< G_c A_i [J]
  double released_energy = 0.;   ///< by all contacts of the particle [J]
  double kinetic_energy = 0.;    ///< of the mass that left [J]
  double removed_volume = 0.;    ///< V_i [m^3]
  double width = 0.;             ///< lambda [rad]
  double depth = 0.;             ///< theta [m]
  double equivalent_radius = 0.; ///< after [m]
};

/// All contacts of a scene, as input of breakage.
struct ContactSet
{
  ContactBatch &pairs;
  std::span<const std::unique_ptr<Boundary>> boundaries;
};

/// What break_particles has done besides the events.
struct BreakingSum
{
  /// Events refused because the shape would have lost r > 0.
  int n_refused = 0;
  /// Energy that contacts released when their surfaces were evaluated again
  /// just before an event: that of the cached expansion, not of the event [J].
  double refreshed = 0.;
};

/// Carries out the events that the force loops requested (ContactBatch::event),
/// by particle, then by contact: of the two sides of a contact the one with the
/// larger E_e / E_b breaks. A side that no longer meets the criterion after
/// earlier events of the step is left alone. Particles change shape, mass and
/// inertia; their contacts are evaluated again (those that open are marked
/// where patches keep factors), the loads of particles are not. Events go to
/// `events`.
BreakingSum break_particles(const ForceContext &context,
                            ParticleSystem &particles, ContactSet &contacts,
                            double time, std::vector<BreakageEvent> &events);
} // namespace dem
