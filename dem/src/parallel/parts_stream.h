#pragma once

#include "parts.h"

#include <iosfwd>
#include <unordered_map>

/// Particles with their contacts to and from parcels and files.
namespace dem
{
/// Particles that leave, and where each of them stands among them.
struct Leaving
{
  Rows rows;
  std::unordered_map<std::int32_t, std::int32_t> number;

  void add(std::int32_t row)
  {
    number[row] = static_cast<std::int32_t>(rows.size());
    rows.push_back(row);
  }
};

/// Writes particles with all that goes with them but their series; partners
/// are named by id.
void write_parts(std::ostream &out, const DistributedParts &parts,
                 const Leaving &leaving);
/// Appends them to `parts`; their series are null.
void read_parts(std::istream &in, const DistributedParts &parts);

/// The same as a parcel for a rank, with the keys of the series.
Parcel parcel_of(const DistributedParts &parts, int rank,
                 const Leaving &leaving, SeriesPool &pool);
/// Appends what the parcels hold, with the series that the pool knows or
/// fetches. Collective.
void take_parcels(const std::vector<Parcel> &parcels, const Ranks &ranks,
                  const DistributedParts &parts, SeriesPool &pool);
} // namespace dem
