#pragma once

#include "communicator.h"

#include <dem/parallel/ranks.h>

namespace dem
{
/// Ranks::deliver() by messages in `own`, which are announced by a plan of
/// Zoltan in `planning`. Collective.
std::vector<Parcel>
deliver_parcels(const Communicator &own,
                std::shared_ptr<const Communicator> planning,
                std::vector<Parcel> parcels);
} // namespace dem
