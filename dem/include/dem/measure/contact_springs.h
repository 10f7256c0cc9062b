#pragma once

#include <dem/engine.h>
#include <dem/integrate/stable_step.h>

namespace dem
{
/// The springs of the contacts as they stand, and as they may stand before
/// `horizon` has passed [s]: every gap is closed, and every overlap grows, by
/// the present relative speed times `horizon`; a wall that is then touched
/// counts, and for a particle with no contact near an impact. All springs count
/// as if none slid. With a horizon the shortest Hertz impact is noted, too: a
/// contact in which the energy of the closing motion exceeds that of its
/// spring, and a millionth of the energy of all particles. Vertices of the
/// facet surfaces are the points, one surface after the other, with their
/// FacetSurface::mass; those that are prescribed are walls. Contacts with the
/// surface count while they touch.
///
/// The only reader of the contact columns here: what follows works on springs.
/// On many ranks of the contacts that this rank owns, until share_springs().
/// Collective.
SpringNetwork contact_springs(const Engine &engine, double horizon);

/// Gives each rank the contacts of all bodies that it owns, in an order that
/// does not depend on the ranks: steps of the network have the same bits on any
/// number of them. Particles belong to their owners, points to one rank each.
/// After this no body may be added or renumbered. Collective.
void share_springs(const Engine &engine, SpringNetwork &network);

/// Stable step of the lightest particle where three walls meet, for what the
/// scene may come to; infinite for a law whose stiffness grows with the overlap
/// [s].
double corner_step(const EngineParameters &parameters,
                   const ParticleSystem &particles);
} // namespace dem
