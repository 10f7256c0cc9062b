#pragma once

#include <dem/shape/body.h>
#include <dem/shape/direction_grid.h>

#include <memory>
#include <vector>

namespace dem
{
/// The radius of a shape on a grid of directions and the heights of its hull,
/// to look up what need not be exact: where two stones may touch. About 25 kB.
class RadiusMap
{
public:
  static constexpr DirectionGrid nodes{48, 96}; ///< of the radius
  static constexpr DirectionGrid sides{24, 48}; ///< of the hull

  /// Samples the series; null: a unit sphere.
  explicit RadiusMap(std::shared_ptr<const Coefficients> sampled);

  /// The shape that was sampled.
  const std::shared_ptr<const Coefficients> &source() const { return series; }

  /// Point of the surface at a node, in units of the series [-] or [m].
  const Eigen::Vector3f &point(int node) const
  {
    return points[static_cast<std::size_t>(node)];
  }

  /// What the grid says of one direction.
  struct Look
  {
    double radius = 0.; ///< by bilinear interpolation [-] or [m]
    /// Cosine of the angle between the ray and the normal of the surface [-]
    double cosine = 1.;
  };
  /// At any direction, not necessarily unit.
  Look towards(const Vec3 &direction) const;

  /// The hull in one direction.
  struct Height
  {
    double height = 0.; ///< no point is higher along it [-] or [m]
    int node = 0;       ///< one that is nearly as high
  };
  /// Along a unit vector.
  Height height(const Vec3 &direction) const;

private:
  void measure_hull();
  /// A node or one beside it, whichever is highest.
  int highest_neighbour(int node, const Eigen::Vector3f &direction) const;

  std::shared_ptr<const Coefficients> series;
  GridValues radius, hull;
  std::vector<Eigen::Vector3f> points; ///< of the nodes
  std::vector<std::int32_t> summit;    ///< node that is highest along a side
  double hull_slack = 0.; ///< what the hull may be higher than its table
};
} // namespace dem
