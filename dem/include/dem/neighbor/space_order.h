#pragma once

#include <dem/contact/batch.h>
#include <dem/vector.h>

#include <cstdint>
#include <vector>

namespace dem
{
/// Particles along a Z-curve (Morton 1966) through cubes about as large as a
/// particle: order[k] is the particle that comes k-th. Neighbours in space are
/// then neighbours in memory.
std::vector<std::int32_t> space_order(const std::vector<Vec3> &position);

/// What is where after the particles were put in this order: new_row[order[k]]
/// = k.
std::vector<std::int32_t> new_rows(const std::vector<std::int32_t> &order);

/// The contacts name the particles by their new rows and stand in the order
/// (a, b) again.
void renumber_pairs(const std::vector<std::int32_t> &new_row,
                    ContactBatch &batch);
} // namespace dem
