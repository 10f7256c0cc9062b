#include "closed_mesh.h"

#include <dem/shape/measures.h>
#include <dem/shape/mesh_curvature.h>
#include <dem/shape/patch.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace dem
{
namespace
{
using Index = std::size_t;

/// Points that edges connect to each point, in rows.
struct PointLinks
{
  std::vector<Index> start; ///< of each row, and the end of the last
  std::vector<Index> other;

  std::span<const Index> of(Index point) const
  {
    return std::span(other).subspan(start[point],
                                    start[point + 1] - start[point]);
  }
};

PointLinks links_of(const TriangleMesh &mesh)
{
  std::vector<std::pair<Index, Index>> links;
  for (const auto &triangle : mesh.triangles)
    for (Index c = 0; c < 3; ++c)
    {
      const Index a = Index(triangle[c]), b = Index(triangle[(c + 1) % 3]);
      links.push_back({a, b});
      links.push_back({b, a});
    }
  std::ranges::sort(links);
  const auto repeated = std::ranges::unique(links);
  links.erase(repeated.begin(), repeated.end());
  PointLinks rows{std::vector<Index>(mesh.points.size() + 1, 0), {}};
  for (const auto &[from, to] : links)
  {
    ++rows.start[from + 1];
    rows.other.push_back(to);
  }
  std::partial_sum(rows.start.begin(), rows.start.end(), rows.start.begin());
  return rows;
}

std::vector<Vec3> point_normals(const TriangleMesh &mesh)
{
  std::vector<Vec3> normals(mesh.points.size(), Vec3::Zero());
  for (const auto &[a, b, c] : mesh.triangles)
  {
    const Vec3 &origin = mesh.points[Index(a)];
    const Vec3 twice =
        (mesh.points[Index(b)] - origin).cross(mesh.points[Index(c)] - origin);
    for (const std::int32_t corner : {a, b, c})
      normals[Index(corner)] += twice;
  }
  for (Vec3 &normal : normals)
    normal.normalize();
  return normals;
}

/// Gathers the points of a patch, ring by ring.
class PatchPoints
{
public:
  PatchPoints(const TriangleMesh &its_mesh, double its_radius)
      : mesh(its_mesh), links(links_of(mesh)), radius(its_radius),
        seen_from(mesh.points.size(), mesh.points.size())
  {
  }

  /// The point itself first.
  const std::vector<Index> &around(Index point)
  {
    constexpr int least_rings = 2;
    points.assign(1, point);
    seen_from[point] = point;
    Index ring_start = 0;
    for (int ring = 1; ring_start < points.size(); ++ring)
    {
      const Index ring_end = points.size();
      for (Index k = ring_start; k < ring_end; ++k)
        for (const Index next : links.of(points[k]))
        {
          const double distance =
              (mesh.points[next] - mesh.points[point]).norm();
          if (seen_from[next] == point ||
              (ring > least_rings && distance > radius))
            continue;
          seen_from[next] = point;
          points.push_back(next);
        }
      ring_start = ring_end;
    }
    return points;
  }

private:
  const TriangleMesh &mesh;
  PointLinks links;
  double radius;
  std::vector<Index> seen_from; ///< the last point whose patch has it
  std::vector<Index> points;
};

/// Eigenvalues of I^-1 II of the patch z = a + b x + c y + d x y + e x^2 + h
/// y^2 at x = y = 0.
PointCurvature curvature_of(const Eigen::Matrix<double, 6, 1> &patch)
{
  const double b = patch[1], c = patch[2];
  Eigen::Matrix2d first, second;
  first << 1. + b * b, b * c, b * c, 1. + c * c;
  second << 2. * patch[4], patch[3], patch[3], 2. * patch[5];
  second /= -std::sqrt(1. + b * b + c * c);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix2d> solver(
      second, first, Eigen::EigenvaluesOnly);
  return {solver.eigenvalues()[1], solver.eigenvalues()[0]};
}

PointCurvature fit_patch(const TriangleMesh &mesh,
                         const std::vector<Index> &points, const Vec3 &normal)
{
  const Vec3 x_axis = normal.unitOrthogonal(), y_axis = normal.cross(x_axis);
  double size = 0.; // so that all columns have similar lengths
  for (const Index k : points)
    size = std::max(size, (mesh.points[k] - mesh.points[points[0]]).norm());
  Eigen::Matrix<double, Eigen::Dynamic, 6> columns(points.size(), 6);
  Eigen::VectorXd heights(points.size());
  for (Index row = 0; row < points.size(); ++row)
  {
    const Vec3 offset =
        (mesh.points[points[row]] - mesh.points[points[0]]) / size;
    const double x = offset.dot(x_axis), y = offset.dot(y_axis);
    columns.row(Eigen::Index(row)) << 1., x, y, x * y, x * x, y * y;
    heights[Eigen::Index(row)] = offset.dot(normal);
  }
  PointCurvature scaled =
      curvature_of(columns.colPivHouseholderQr().solve(heights));
  return {scaled.maximum / size, scaled.minimum / size};
}

double mean_edge(const TriangleMesh &mesh)
{
  double sum = 0.;
  for (const auto &triangle : mesh.triangles)
    for (Index c = 0; c < 3; ++c)
      sum += (mesh.points[Index(triangle[c])] -
              mesh.points[Index(triangle[(c + 1) % 3])])
                 .norm();
  return sum / (3. * double(mesh.triangles.size()));
}

/// Shares of the area, the median difference and the residual.
void add_sums(double mean_radius, CornerComparison &all)
{
  double area = 0., square = 0.;
  std::vector<std::pair<double, double>> differences; // and their areas
  for (const ComparedPoint &point : all.points)
  {
    area += point.area;
    all.agreement +=
        point.is_mesh_corner == point.is_series_corner ? point.area : 0.;
    all.corners_mesh += point.is_mesh_corner ? point.area : 0.;
    all.corners_series += point.is_series_corner ? point.area : 0.;
    all.corners_both +=
        point.is_mesh_corner && point.is_series_corner ? point.area : 0.;
    const double residual =
        (point.radius_series - point.radius_mesh) / mean_radius;
    square += point.area * residual * residual;
    differences.push_back(
        {std::abs(point.curvature_series - point.curvature_mesh) *
             all.inscribed_series,
         point.area});
  }
  for (double *share : {&all.agreement, &all.corners_mesh, &all.corners_series,
                        &all.corners_both})
    *share /= area;
  all.residual_rms = std::sqrt(square / area);
  std::ranges::sort(differences);
  double below = 0.;
  for (const auto &[difference, its_area] : differences)
  {
    all.median_difference = difference;
    if ((below += its_area) >= 0.5 * area)
      break;
  }
}
} // namespace

std::vector<PointCurvature> mesh_curvatures(const TriangleMesh &mesh,
                                            double radius)
{
  const std::vector<Vec3> normals = point_normals(mesh);
  PatchPoints patch(mesh, radius);
  std::vector<PointCurvature> curvatures;
  for (Index k = 0; k < mesh.points.size(); ++k)
    curvatures.push_back(fit_patch(mesh, patch.around(k), normals[k]));
  return curvatures;
}

std::vector<double> point_areas(const TriangleMesh &mesh)
{
  std::vector<double> areas(mesh.points.size(), 0.);
  for (const auto &[a, b, c] : mesh.triangles)
  {
    const Vec3 &origin = mesh.points[Index(a)];
    const double third = (mesh.points[Index(b)] - origin)
                             .cross(mesh.points[Index(c)] - origin)
                             .norm() /
                         6.;
    for (const std::int32_t corner : {a, b, c})
      areas[Index(corner)] += third;
  }
  return areas;
}

CornerComparison compare_corners(const TriangleMesh &mesh,
                                 std::span<const double> series, double patch)
{
  detail::ClosedMesh closed = detail::close_mesh(mesh);
  for (Vec3 &point : closed.mesh.points)
    point -= closed.centroid;
  const double mean_radius = series[0] * equivalent_radius_factor;
  CornerComparison all;
  all.patch_radius = patch * mean_radius;
  all.edge_length = mean_edge(closed.mesh);
  all.inscribed_series =
      std::ranges::min(node_radii(series, standard_quadrature()));
  all.inscribed_mesh = closed.mesh.points[0].norm();
  for (const Vec3 &point : closed.mesh.points)
    all.inscribed_mesh = std::min(all.inscribed_mesh, point.norm());
  const std::vector<PointCurvature> curvatures =
      mesh_curvatures(closed.mesh, all.patch_radius);
  const std::vector<double> areas = point_areas(closed.mesh);
  for (Index k = 0; k < closed.mesh.points.size(); ++k)
  {
    ComparedPoint point;
    point.radius_mesh = closed.mesh.points[k].norm();
    if (!(point.radius_mesh > 0.))
      throw std::invalid_argument(
          "mesh has a point at its centroid: it is not star-shaped");
    point.direction = closed.mesh.points[k] / point.radius_mesh;
    point.area = areas[k];
    const RadialExpansion expansion = expand(series, point.direction);
    point.radius_series = expansion.radius;
    point.curvature_mesh = curvatures[k].maximum;
    point.curvature_series = principal_curvatures(expansion).maximum;
    point.is_mesh_corner = is_corner(point.curvature_mesh, all.inscribed_mesh);
    point.is_series_corner =
        is_corner(point.curvature_series, all.inscribed_series);
    all.points.push_back(point);
  }
  add_sums(mean_radius, all);
  return all;
}
} // namespace dem
