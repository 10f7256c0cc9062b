#pragma once

#include <Eigen/Core>

#include <span>
#include <vector>

namespace dem
{
/// Corners of a closed polygon in a plane [m]; what it encloses lies to its
/// left. The last corner is joined to the first.
using Polygon = std::vector<Eigen::Vector2d>;

/// Enclosed area; negative where the polygon is clockwise, as round a hole
/// [m^2].
double polygon_area(const Polygon &polygon);
double polygon_area(std::span<const Polygon> polygons);

/// Centroid of the enclosed area; the mean of the corners where it is zero [m].
Eigen::Vector2d polygon_centroid(const Polygon &polygon);

/// A regular polygon of 72 corners on a circle.
Polygon circle_polygon(const Eigen::Vector2d &centre, double radius);

/// The polygon without corners that lie within a tolerance [m] of the line
/// that replaces them (Douglas and Peucker 1973).
Polygon simplified(const Polygon &polygon, double tolerance);
} // namespace dem
