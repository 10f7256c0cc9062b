#pragma once

#include <dem/contact/wall_place.h>
#include <dem/search/spots.h>

#include <span>
#include <vector>

namespace dem
{
/// A stone as the search for places on walls sees it.
struct PosedStone
{
  MappedStone stone;
  Vec3 position = Vec3::Zero();     ///< [m]
  Mat3 rotation = Mat3::Identity(); ///< body frame to world
};

/// What a search for the places where a stone meets a wall has found.
struct WallSearchResult
{
  std::vector<WallPlace> places; ///< overlap > -margin, deepest first
  int n_lost = 0;                ///< minima of the nodes that led to no place
};

/// Whether two places on a wall are one: beside each other on the stone, on one
/// patch of the wall.
bool is_one_place(const WallPlace &one, const WallPlace &other);

/// All places where a stone meets a triangulated surface or comes within
/// `margin` [m]: from the nodes of its map that are nearest to the surface
/// among their neighbours, and from vertices that are deepest in the stone
/// among theirs, by climb_facets(). Only these triangles are looked at. Places
/// beside `known` ones are left out.
WallSearchResult find_on_facets(const PosedStone &stone, const FacetMesh &mesh,
                                std::span<const std::int32_t> triangles,
                                double margin,
                                std::span<const WallPlace> known = {});

/// The same on the cylinder or an end of a drum.
WallSearchResult find_on_drum(const PosedStone &stone, const Drum &drum,
                              DrumPart part, double margin,
                              std::span<const WallPlace> known = {});
} // namespace dem
