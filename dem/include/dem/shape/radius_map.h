#pragma once

#include <dem/shape/body.h>
#include <dem/shape/direction_grid.h>

#include <memory>
#include <vector>

namespace dem
{
/// The radius of a shape on a grid of directions and the heights of its hull,
/// to look up what need not be exact: where two stones may touch. About 30 kB.
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
  Eigen::Vector3f point(int node) const;

  /// Radii of the nodes, as GridValues has them.
  const float *radii() const { return radius.data(); }

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

  std::shared_ptr<const Coefficients> series;
  GridValues radius, hull;
  std::vector<std::int32_t> summit; ///< node that is highest along a side
  double hull_slack = 0.; ///< what the hull may be higher than its table
};
} // namespace dem
