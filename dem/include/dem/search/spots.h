#pragma once

#include <dem/contact/common_normal.h>
#include <dem/shape/radius_map.h>

#include <span>
#include <vector>

namespace dem
{
/// Lenses deeper than this part of the radius are none: the common normal of
/// far sides of two stones.
inline constexpr double deepest_overlap = 0.3;

/// A stone as the search for spots sees it.
struct MappedStone
{
  const Body &body;
  const RadiusMap &map;
};

/// Two stones, B as A sees it.
struct MappedPair
{
  MappedStone a, b;
  RelativePose pose;
};

/// A slab between the hulls of two stones.
struct Separation
{
  Vec3 normal = Vec3::UnitZ(); ///< unit, from A to B, body frame of A [-]
  double gap = 0.; ///< between the hulls along it; < 0: they overlap [m]
  /// No point of A, or of B, is higher from its centre towards the other [m].
  double top_a = 0., top_b = 0.;
};

/// The widest slab between the hulls that a few steps find from a first guess
/// (Gilbert 1966); its gap is a lower bound of that between the stones. Where
/// this bound is below `margin` [m] and may not be tight, the tops along the
/// normal are found on the series.
Separation separate(const MappedPair &pair, const Vec3 &guess,
                    double margin = 0.);

/// Whether two stones overlap or come within `margin`, as far as the nodes of
/// their maps can tell [m].
bool may_touch(const MappedPair &pair, double margin);

/// What a search for the places where two stones meet has found.
struct SpotSearch
{
  std::vector<Spot> spots; ///< overlap > -margin, nearest first
  int n_lost = 0; ///< minima of the maps that led to no lens of contact
};

/// All places where two stones meet or come within `margin` [m]: local minima
/// of the gap over the nodes of either stone inside the slab of `separation`
/// (of this pose), each followed to the common normal. Places beside one of
/// the `known` ones are left out.
SpotSearch find_spots(const MappedPair &pair, const Separation &separation,
                      double margin, std::span<const Spot> known = {});

/// Whether two places on stone A are one.
bool is_one_place(const Spot &one, const Spot &other);

/// Heights along a normal from the centre of a stone [m].
struct SupportHeights
{
  double lowest = 0.; ///< that matters
  double wall = 0.;   ///< where the overlap begins
};

/// All places of a stone that are farthest along a unit vector of its body
/// frame among their neighbours and high enough. Places beside `known` ones
/// are left out.
std::vector<Spot> find_supports(const MappedStone &stone, const Vec3 &normal,
                                const SupportHeights &heights,
                                std::span<const Spot> known = {});
} // namespace dem
