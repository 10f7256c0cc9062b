#include <dem/binary.h>
#include <dem/boundary/plane_boundary.h>
#include <dem/boundary/wall_candidates.h>
#include <dem/boundary/wall_point_lists.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace dem
{
std::string PlaneBoundary::name_of(std::size_t k) const
{
  const Vec3 &normal = planes[static_cast<std::size_t>(batch.b[k])].normal;
  char text[80];
  std::snprintf(text, sizeof text, "the plane of the normal (%.3g, %.3g, %.3g)",
                normal.x(), normal.y(), normal.z());
  return text;
}

void PlaneBoundary::move(double time_step)
{
  for (Plane &plane : planes)
  {
    plane.point += time_step * plane.velocity;
    // Trapezoidal rule: this half with the old force, apply_loads the other.
    plane.work -= 0.5 * time_step * plane.force.dot(plane.velocity);
    plane.impulse += 0.5 * time_step * plane.force;
  }
}

double PlaneBoundary::speed() const
{
  double square = 0.;
  for (const Plane &plane : planes)
    if (plane.is_active)
      square = std::max(square, plane.velocity.squaredNorm());
  return std::sqrt(square);
}

double PlaneBoundary::beyond(const Vec3 &point) const
{
  double most = -std::numeric_limits<double>::infinity();
  for (const Plane &plane : planes)
    if (plane.is_active)
      most = std::max(most, (plane.point - point).dot(plane.normal));
  return most;
}

void PlaneBoundary::find_candidates(const BoundarySearch &search)
{
  ContactPointSearchInput input = search.points;
  const ParticleSystem &particles = input.context.particles;
  const EngineParameters &parameters = input.context.parameters;
  input.layout = wall_layout(parameters, material, particles);
  if (input.layout.has_contact_points)
    search.events += renew_planes(input, {planes, search.rigid_path}, supports,
                                  batch, search.retired);
  else
    rebuild_planes(particles, planes,
                   {input.layout, parameters.geometry.wall_geometry,
                    search.skin + input.layout.law.range()},
                   batch, search.retired);
}

ForceSum PlaneBoundary::meet(const ForceContext &)
{
  rows.resize(planes.size());
  for (std::size_t p = 0; p < planes.size(); ++p)
  {
    const Plane &plane = planes[p];
    rows[p] = {plane.point,    -plane.normal, plane.velocity,
               plane.velocity, -plane.normal, 0.};
  }
  return {};
}

BoundarySums PlaneBoundary::sum_loads(const SumGrid &grid)
{
  load_sums.assign(planes.size(), {});
  for (std::size_t k = 0; k < batch.size(); ++k)
  {
    LoadSum &sum = load_sums[static_cast<std::size_t>(batch.b[k])];
    const Vec3 &force = batch.load[k].force;
    sum.force -= force;
    sum.size += force.cwiseAbs();
  }
  force_sums.assign(3 * planes.size(), {});
  const bool is_exact = std::ranges::all_of(
      load_sums, [&grid](const LoadSum &sum)
      { return sum.size.maxCoeff() <= grid.largest_sum(); });
  if (is_exact)
    for (std::size_t p = 0; p < planes.size(); ++p)
      add_force(load_sums[p].force, p);
  else
    for (std::size_t k = 0; k < batch.size(); ++k)
      add_force(-batch.load[k].force, static_cast<std::size_t>(batch.b[k]));
  return {force_sums};
}

void PlaneBoundary::add_force(const Vec3 &force, std::size_t plane)
{
  for (std::size_t d = 0; d < 3; ++d)
    force_sums[3 * plane + d].add(force[static_cast<Eigen::Index>(d)]);
}

void PlaneBoundary::apply_loads(double time_step)
{
  for (std::size_t p = 0; p < planes.size(); ++p)
    for (std::size_t d = 0; d < 3; ++d)
      planes[p].force[static_cast<Eigen::Index>(d)] =
          force_sums[3 * p + d].value();
  for (Plane &plane : planes)
  {
    plane.work -= 0.5 * time_step * plane.force.dot(plane.velocity);
    plane.impulse += 0.5 * time_step * plane.force;
  }
}

double PlaneBoundary::work() const
{
  double sum = 0.;
  for (const Plane &plane : planes)
    sum += plane.work;
  return sum;
}

void PlaneBoundary::pack_parts(std::ostream &out) const
{
  write_column(out, planes);
  write_column(out, supports);
}

void PlaneBoundary::unpack_parts(std::istream &in)
{
  read_column(in, planes);
  read_column(in, supports);
}
} // namespace dem
