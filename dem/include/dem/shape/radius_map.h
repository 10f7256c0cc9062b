#pragma once

#include <dem/shape/direction_grid.h>
#include <dem/shape/particle_shape.h>

#include <memory>
#include <vector>

namespace dem
{
/// The radius of a shape on a grid of directions and the heights of the hull of
/// these nodes, to look up where two particles may touch. What the surface may
/// do between the nodes is bounded by sag() and spacing(). About 30 kB.
class RadiusMap
{
public:
  static constexpr DirectionGrid nodes{48, 96}; ///< of the radius
  static constexpr DirectionGrid sides{24, 48}; ///< of the hull
  /// Blocks have so many rings and columns of nodes.
  static constexpr int block_side = 4;
  static constexpr DirectionGrid blocks{nodes.n_polar / block_side,
                                        nodes.n_azimuth / block_side};

  /// Samples the series; null: a unit sphere.
  explicit RadiusMap(std::shared_ptr<const Coefficients> sampled);

  /// The shape that was sampled.
  const std::shared_ptr<const Coefficients> &source() const { return series; }

  /// Point of the surface at a node, in units of the series [-] or [m].
  Eigen::Vector3f point(int node) const;

  /// Radii of the nodes, as GridValues has them.
  const float *radii() const { return radius.data(); }

  /// The surface is nowhere higher along a direction than the highest node by
  /// more than this: d^2 / 2 max|x''| with d the way from a point to the next
  /// node, x'' along great circles [-] or [m].
  double sag() const { return rest; }
  /// No point of the surface is farther from the next node [-] or [m].
  double spacing() const { return widest; }
  /// No node of a block is farther from its first node [-] or [m].
  double block_reach(int block) const
  {
    return reach[static_cast<std::size_t>(block)];
  }
  /// The first node of a block.
  static constexpr int first_node(int block)
  {
    return block / blocks.n_azimuth * block_side * nodes.n_azimuth +
           block % blocks.n_azimuth * block_side;
  }

  /// The hull of the nodes in one direction.
  struct Height
  {
    double height = 0.; ///< no node is higher along it [-] or [m]
    int node = 0;       ///< one that is nearly as high
  };
  /// Along a unit vector.
  Height height(const Vec3 &direction) const;

private:
  void measure_nodes();
  void measure_hull();

  std::shared_ptr<const Coefficients> series;
  GridValues radius, hull;
  std::vector<std::int32_t> summit; ///< node that is highest along a side
  std::vector<float> reach;         ///< of each block
  double hull_tolerance = 0.; ///< what the hull may be higher than its table
  double farthest = 0.;       ///< node from the origin
  double rest = 0., widest = 0.;
};
} // namespace dem
