#pragma once

#include <dem/contact/common_normal.h>

namespace dem
{
/// Axes about a point of a surface in its columns: two tangents across the
/// normal n and the normal, right-handed (Duff et al. 2017). The length of n is
/// one to the digits of the columns, and so are the axes.
Mat3 surface_axes(const Vec3 &normal);

/// The osculating paraboloid of a surface at its vertex, with position p,
/// normal n and shape operator K there: x(w) = p + w - (w.K w / 2) n for w
/// across n.
struct Paraboloid
{
  SurfacePoint vertex;

  /// The point x(w); its normal is that of the paraboloid.
  SurfacePoint at(const Vec3 &w) const;
  /// w of the point that a direction from the centre meets.
  Vec3 offset_towards(const Vec3 &direction) const;
  /// Height of the vertex over the centre along the normal [m].
  double height() const { return vertex.position.dot(vertex.normal); }
};
} // namespace dem
