#pragma once

#include <dem/breakage/events.h>
#include <dem/parallel/distribution.h>

namespace dem
{
/// break_particles() where the particles are spread over ranks. Events are rare
/// and reach one particle with its contacts each. Every rank gets copies of the
/// particles that are to break, of their partners and of all contacts of them,
/// carries out the same events in the same order, and takes over what it holds:
/// contacts, owned particles, ghosts. All ranks return the same. Collective.
BreakingSum break_shared(const ForceContext &context,
                         const DistributedParts &parts,
                         Distribution &distribution, double time,
                         std::vector<BreakageEvent> &events);
} // namespace dem
