#include "depth_model.h"

#include <algorithm>

namespace dem
{
namespace
{
/// A ring of equal maxima is level along itself: this part of the least
/// curvature that steps trust counts as round-off [-].
constexpr double level_curvature = 0.1;

/// The deepest point of the sides by the model.
Ascent best_on_sides(const DepthModel &model, const Corners &corner)
{
  Ascent best;
  for (std::size_t from = 0; from < 3; ++from)
  {
    const std::size_t to = (from + 1) % 3;
    const Vec3 start = corner[from] - model.point,
               side = corner[to] - corner[from];
    // From the point of the side next to that of the model.
    const double square = side.squaredNorm();
    const double foot = std::clamp(-start.dot(side) / square, 0., 1.);
    const Vec3 bent = model.trusted * side;
    const double slope =
        -model.normal.dot(side) - (start + foot * side).dot(bent);
    const double curvature = std::max(side.dot(bent), model.least * square);
    const double s = std::clamp(foot + slope / curvature, 0., 1.);
    const Vec3 step = start + s * side;
    const double gain = model.gain(step);
    if (gain <= best.gain)
      continue;
    best.gain = gain;
    best.step = step;
    best.weight = {};
    best.weight[from] = 1. - s;
    best.weight[to] = s;
  }
  return best;
}
} // namespace

DepthModel::DepthModel(ParticleView &particle,
                       const WallContactPoint &contact_point)
    : point(contact_point.point), normal(contact_point.normal),
      least(facet_step_control.hill / particle.size()),
      longest(facet_step_control.longest_step * particle.size())
{
  const SurfacePoint &at = particle.at(contact_point.on_particle);
  on_particle = at.position;
  const Frame frame = tangents(normal);
  const Mat2 k = frame.transpose() * at.shape_operator * frame;
  const Mat2 inverse =
      floored(Mat2::Identity() - contact_point.overlap * k, lowest_curvature)
          .inverse();
  const Mat2 c = k * inverse;
  follow = frame * inverse * frame.transpose();
  const Mat2 even = 0.5 * (c + c.transpose());
  shape_operator = frame * even * frame.transpose();
  trusted = frame * facet_step_control.trusted(even, particle.size()) *
            frame.transpose();
}

Ascent best_on_triangle(const DepthModel &model, const Corners &corner)
{
  const Vec3 first = corner[1] - corner[0], second = corner[2] - corner[0];
  const Vec3 area = first.cross(second);
  Frame frame;
  frame.col(0) = first.normalized();
  frame.col(1) = area.cross(first).normalized();
  const Mat2 shape_operator = frame.transpose() * model.shape_operator * frame;
  // The point of the model need not lie in this plane.
  const Vec3 above =
      area * ((corner[0] - model.point).dot(area) / area.squaredNorm());
  const Mat2 hill = frame.transpose() * model.trusted * frame;
  const Vec2 shift =
      floored(hill, model.least)
          .llt()
          .solve(-(frame.transpose() * (model.normal + model.trusted * above)));
  const Vec3 step = above + frame * shift;
  const Vec3 from_corner = model.point + step - corner[0];
  const double over = 1. / area.squaredNorm();
  const double w1 = from_corner.cross(second).dot(area) * over,
               w2 = first.cross(from_corner).dot(area) * over;
  const bool is_summit =
      smallest_eigenvalue(shape_operator) > -level_curvature * model.least;
  Ascent ascent;
  if (w1 >= 0. && w2 >= 0. && w1 + w2 <= 1.)
    ascent = {{1. - w1 - w2, w1, w2}, step, model.gain(step), is_summit};
  else
  {
    ascent = best_on_sides(model, corner);
    ascent.is_summit = true;
  }
  return ascent;
}
} // namespace dem
