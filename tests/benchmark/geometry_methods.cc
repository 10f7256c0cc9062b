#include "geometry_methods.h"

#include <Eigen/Eigenvalues>

namespace spall
{
namespace
{
using dem::MappedPair;
using dem::Mat3;
using dem::SurfacePoint;
using dem::Vec3;
using Vec2 = Eigen::Vector2d;
using Mat2 = Eigen::Matrix2d;

double local_radius(const dem::ParticleShape &body, const Vec3 &direction)
{
  return body.scale * dem::radius(*body.series, direction);
}

/// Meeting on the branch u, halfway into the overlap.
Meeting on_branch(const MappedPair &pair, double radius_a, double radius_b)
{
  const double distance = pair.pose.position.norm();
  const Vec3 u = pair.pose.position / distance;
  const double overlap = radius_a + radius_b - distance;
  return {overlap, u, (radius_a - 0.5 * overlap) * u};
}

/// A surface as a height along an axis over the plane across it.
struct HeightField
{
  Vec2 position;  ///< in the plane [m]
  double height;  ///< [m]
  Vec2 slope;     ///< [-]
  Mat2 second;    ///< derivatives [1/m]
  Vec3 direction; ///< in the frame of the particle, unit [-]
};

/// Two unit vectors across the branch and the branch itself, as columns.
using Axes = Mat3;

/// Of a particle at a direction of its body frame; `rotation` takes body to the
/// frame of the axes; `up` is 1 for A and -1 for B, which looks back.
HeightField height_field(const dem::ParticleShape &body, const Vec3 &direction,
                         const Mat3 &rotation, const Axes &axes, double up)
{
  const SurfacePoint p =
      dem::turned(dem::surface_point(body, direction), rotation);
  const Vec3 u = up * axes.col(2);
  const double along = p.normal.dot(u);
  HeightField field;
  field.position = {p.position.dot(axes.col(0)), p.position.dot(axes.col(1))};
  field.height = p.position.dot(u);
  field.slope = {-p.normal.dot(axes.col(0)) / along,
                 -p.normal.dot(axes.col(1)) / along};
  Eigen::Matrix<double, 3, 2> tangents;
  for (int k = 0; k < 2; ++k)
    tangents.col(k) = axes.col(k) + field.slope[k] * u;
  field.second = -tangents.transpose() * p.shape_operator * tangents / along;
  field.direction = direction;
  return field;
}

/// The direction in which the surface is over a point of the plane, by the
/// second-order height there.
Vec3 direction_over(const HeightField &field, const Vec2 &position,
                    const Mat3 &rotation, const Axes &axes, double up)
{
  const Vec2 move = position - field.position;
  const double height = field.height + field.slope.dot(move) +
                        0.5 * move.dot(field.second * move);
  const Vec3 point = position.x() * axes.col(0) + position.y() * axes.col(1) +
                     up * height * axes.col(2);
  return (rotation.transpose() * point).normalized();
}

/// Eigenvalues at most -0.3 / r.
Mat2 made_concave(const Mat2 &second, double radius)
{
  Eigen::SelfAdjointEigenSolver<Mat2> solver(0.5 *
                                             (second + second.transpose()));
  const Vec2 values = solver.eigenvalues().cwiseMin(-0.3 / radius);
  return solver.eigenvectors() * values.asDiagonal() *
         solver.eigenvectors().transpose();
}
} // namespace

Meeting by_balls(const MappedPair &pair)
{
  return on_branch(pair, dem::mean_radius(pair.a.body),
                   dem::mean_radius(pair.b.body));
}

Meeting by_radii(const MappedPair &pair)
{
  const Vec3 u = pair.pose.position.normalized();
  return on_branch(
      pair, local_radius(pair.a.body, u),
      local_radius(pair.b.body, pair.pose.rotation.transpose() * -u));
}

Meeting by_heights(const MappedPair &pair, int n_corrections)
{
  const double distance = pair.pose.position.norm();
  Axes axes;
  axes.col(2) = pair.pose.position / distance;
  axes.col(0) = axes.col(2).unitOrthogonal();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  const double size =
      std::min(dem::mean_radius(pair.a.body), dem::mean_radius(pair.b.body));
  const Mat3 &turn = pair.pose.rotation;
  const Vec3 back = turn.transpose() * -axes.col(2);
  HeightField a = height_field(pair.a.body, axes.col(2), Mat3::Identity(), axes,
                               1.),
              b = height_field(pair.b.body, back, turn, axes, -1.);
  Meeting result;
  for (int k = 0; k < n_corrections; ++k)
  {
    const Mat2 second = made_concave(a.second + b.second, size);
    // Both heights about the point of A.
    const Vec2 apart = a.position - b.position;
    const Vec2 gradient = a.slope + b.slope + b.second * apart;
    Vec2 move = -second.inverse() * gradient;
    if (const double longest = 0.35 * size; move.norm() > longest)
      move *= longest / move.norm();
    const double sum = a.height + b.height + b.slope.dot(apart) +
                       0.5 * apart.dot(b.second * apart) + gradient.dot(move) +
                       0.5 * move.dot(second * move);
    const Vec2 position = a.position + move, slope = a.slope + a.second * move;
    result.overlap = sum - distance;
    result.normal =
        (axes.col(2) - slope.x() * axes.col(0) - slope.y() * axes.col(1))
            .normalized();
    result.arm = position.x() * axes.col(0) + position.y() * axes.col(1) +
                 (a.height + a.slope.dot(move) +
                  0.5 * move.dot(a.second * move) - 0.5 * result.overlap) *
                     axes.col(2);
    if (k + 1 == n_corrections)
      break;
    a = height_field(pair.a.body,
                     direction_over(a, position, Mat3::Identity(), axes, 1.),
                     Mat3::Identity(), axes, 1.);
    b = height_field(pair.b.body, direction_over(b, position, turn, axes, -1.),
                     turn, axes, -1.);
  }
  return result;
}

namespace
{
Meeting meeting_at(const MappedPair &pair,
                   const dem::ContactPoint &contact_point)
{
  if (!contact_point.is_found)
    return {0., Vec3::UnitX(), Vec3::Zero(), false};
  const SurfacePoint p = dem::surface_point(pair.a.body, contact_point.on_a);
  return {contact_point.overlap, p.normal,
          p.position - 0.5 * contact_point.overlap * p.normal};
}
} // namespace

dem::ContactPoint deepest_contact_point(const MappedPair &pair, double margin)
{
  const dem::ContactPointSearch found = dem::find_contact_points(
      pair, dem::separate(pair, pair.pose.position.normalized()), margin);
  return found.contact_points.empty() ? dem::ContactPoint{}
                                      : found.contact_points.front();
}

Meeting by_search(const MappedPair &pair, double margin)
{
  return meeting_at(pair, deepest_contact_point(pair, margin));
}

Meeting by_refinement(const MappedPair &pair, const dem::ContactPoint &start)
{
  return meeting_at(pair,
                    dem::refine(pair.a.body, pair.b.body, pair.pose, start));
}

std::optional<MappedPair> bring_together(const MappedPair &from)
{
  const double size =
      std::min(dem::mean_radius(from.a.body), dem::mean_radius(from.b.body));
  const Vec3 along = from.pose.position.normalized();
  MappedPair pair = from;
  double distance = pair.pose.position.norm();
  dem::ContactPoint contact_point;
  // Careful while far: another point may come nearer first.
  for (int step = 0; step < 200; ++step)
  {
    pair.pose.position = distance * along;
    contact_point = deepest_contact_point(pair, 0.2 * size);
    const double gap =
        contact_point.is_found ? -contact_point.overlap : 0.2 * size;
    if (std::abs(gap) < 1e-9 * size)
      return pair;
    distance -= gap > 1e-3 * size ? 0.5 * gap : gap;
  }
  return {};
}
} // namespace spall
