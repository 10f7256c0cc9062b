#pragma once

#include <dem/packing/random.h>
#include <dem/shape/body.h>

#include <span>
#include <vector>

namespace dem
{
struct Placement
{
  Vec3 position = Vec3::Zero(); ///< [m]
  Quaternion orientation = Quaternion::Identity();
};

/// Random sequential insertion of the stones, in their order, into the box
/// [lower, upper] without overlap along any branch line or towards any face.
/// Throws std::runtime_error if a stone finds no place in 20 000 tries.
std::vector<Placement> insert_stones(std::span<const Body> stones,
                                     const Vec3 &lower, const Vec3 &upper,
                                     Random &random);
} // namespace dem
