#pragma once

#include <dem/boundary/facet_boundary.h>
#include <dem/boundary/wall_motion.h>

namespace dem
{
/// Sum of the loads on the vertices of a surface, with the moment about a
/// point.
WallLoad load_on(const FacetSurface &surface, const Vec3 &about);

/// A rigid wall of any shape: facets that move as one.
class MeshWall final : public FacetBoundary
{
public:
  static constexpr const char *kind_name = "mesh walls";

  /// `number`: of the wall in its scene. Throws std::invalid_argument as
  /// FacetBoundary.
  MeshWall(std::string its_label, std::int64_t its_number,
           const WallMaterial &law, FacetSurface at_start,
           WallMotion its_motion);
  MeshWall() = default;

  std::unique_ptr<Boundary> copy() const override
  {
    return std::make_unique<MeshWall>(*this);
  }
  std::string kind() const override { return kind_name; }
  std::string name_of(std::size_t) const override
  {
    return "the wall '" + label + "'";
  }
  int event_kind() const override { return 4; }
  void move(double time_step) override;

  /// Its motion begins so long after now; infinite: not yet [s].
  void start_in(double delay) { course.start = current.time + delay; }
  /// Of the particles on the wall in the last step.
  WallLoad load() const;
  /// Of a closed wall with the particles outside what it encloses; else 0
  /// [m^3].
  double body_volume() const;
  const WallMotion &motion() const { return course; }
  const WallPose &pose() const { return current; }
  /// Centre of rotation now [m].
  Vec3 centre() const { return course.centre + current.shift; }

private:
  void pack_parts(std::ostream &out) const override;
  void unpack_parts(std::istream &in) override;

  WallMotion course;
  WallPose current;
  std::vector<Vec3> placed; ///< vertices before any motion [m]
};
} // namespace dem
