#pragma once

#include "../row_of.h"

#include <dem/parallel/distribution.h>

#include <cstdint>
#include <vector>

/// Rows of what goes with the particles, and the names of partners: by row as
/// long as the rows stay, by id where particles go to other ranks or to files.
namespace dem
{
using Rows = std::vector<std::int32_t>;

/// Calls call(candidates) for those of pairs and of each boundary that has
/// some.
template <class Call>
void visit_candidates(const DistributedParts &parts, const Call &call)
{
  call(parts.pair_candidates);
  for (const auto &boundary : parts.boundaries)
    if (std::vector<CandidatePair> *candidates = boundary->candidates())
      call(*candidates);
}

/// The partner of every pair by its id: rows are about to change.
void name_partners_by_id(const DistributedParts &parts);
/// And by its row again; partners that are not here have rows past the last.
void name_partners_by_row(const DistributedParts &parts);
/// Ghosts have got other rows, or are gone (-1).
void renumber_partners(const Rows &new_row, const DistributedParts &parts);

void drop_ghosts(ParticleSystem &particles);
/// The owned particles are these, in this order; contacts of others go.
void keep_particles(const DistributedParts &parts, const Rows &order);
/// Particles in the order of their ids, contacts in that of the particles and
/// of the names of their partners.
void sort_by_id(const DistributedParts &parts);
/// Contacts with boundaries, and candidates, in the order of the particles.
void sort_contacts(const DistributedParts &parts);
} // namespace dem
