#pragma once

namespace dem
{
enum class ContactGeometry
{
  sphere, ///< overlap of the equivalent spheres
  radial, ///< overlap of the local radii along the branch (the article)
  surface ///< the true surfaces at their common normals
};

/// Properties of a geometry that the code uses. A new geometry is one more row
/// in traits().
struct GeometryTraits
{
  /// Contacts read the local shape, as far out as the circumscribed sphere;
  /// otherwise the equivalent sphere alone.
  bool reads_shape = false;
  /// Overlap is that of the local radii along the branch vector.
  bool is_along_branch = false;
  /// Surfaces touch at the points of their common normals, of which a pair may
  /// have several; the motion needs the whole tensor of inertia.
  bool has_common_normal = false;
  /// Cost of a rebuild of the lists, in steps [-].
  double rebuild_cost = 0.;
  /// Cost of a listed pair that does not touch, over that of one that does [-].
  double open_pair_cost = 0.;
};

constexpr GeometryTraits traits(ContactGeometry geometry)
{
  GeometryTraits sphere, radial, surface;
  sphere.rebuild_cost = 8.;
  sphere.open_pair_cost = 0.15;

  radial.reads_shape = true;
  radial.is_along_branch = true;
  radial.rebuild_cost = 8.;
  radial.open_pair_cost = 0.3;

  surface.reads_shape = true;
  surface.has_common_normal = true;
  surface.rebuild_cost = 50.;
  surface.open_pair_cost = 0.3;

  return geometry == ContactGeometry::sphere   ? sphere
         : geometry == ContactGeometry::radial ? radial
                                               : surface;
}

/// The geometry of contacts between particles of which none has a shape.
inline constexpr ContactGeometry geometry_without_shapes =
    ContactGeometry::sphere;
} // namespace dem
