#include "facet_stream.h"

#include <dem/binary.h>
#include <dem/boundary/facet_boundary.h>
#include <dem/boundary/followed_walls.h>
#include <dem/boundary/wall_candidates.h>
#include <dem/boundary/wall_point_lists.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace dem
{
namespace
{
/// Triangles are gathered that far beyond the bound of a particle that they
/// serve its search for some while [bounds].
constexpr double gathering_reach = 1.25;

/// Skin of searches on facets over the radius of the smallest particle.
constexpr double search_skin = 0.04;
/// Part of it that may be used up until the next check: checks cost little,
/// searches cost much.
constexpr double notice_share = 0.5;

template <class Surface, class Visit>
void visit_surface(Surface &surface, const Visit &visit)
{
  visit(surface.triangles);
  visit(surface.position);
  visit(surface.velocity);
  visit(surface.mass);
  visit(surface.load);
}

/// Spacing of the loads on vertices [N]. Where the grid rounds nothing contacts
/// are few: finer than their last digits.
double load_spacing_of(const SumGrid &grid, const ContactBatch &batch)
{
  if (grid.force > 0.)
    return grid.vertex_load();
  double largest = std::numeric_limits<double>::min();
  for (std::size_t k = 0; k < batch.size(); ++k)
    largest = std::max(largest, batch.load[k].force.lpNorm<Eigen::Infinity>());
  return std::ldexp(1., std::max(-1000, std::ilogb(largest) - 57));
}

/// Adds the number next to `value`. What is far beyond the range of the grid
/// is cut off: loads are then added again with another one.
void add_count(double value, std::int64_t &sum)
{
  constexpr double most = 0x1p62;
  const std::int64_t count = std::llrint(std::clamp(value, -most, most));
  // In numbers that may pass their end.
  sum = static_cast<std::int64_t>(static_cast<std::uint64_t>(sum) +
                                  static_cast<std::uint64_t>(count));
}
} // namespace

FacetBoundary::FacetBoundary() : Boundary(WallMaterial{}), topology(surface) {}

FacetBoundary::FacetBoundary(std::string its_label, std::int64_t its_number,
                             const WallMaterial &law, FacetSurface at_start)
    : Boundary(law), label(std::move(its_label)), surface(std::move(at_start)),
      topology(surface), impulse(surface.position.size(), Vec3::Zero()),
      number(its_number), load_before(impulse)
{
  if (law_of(law).entry().attracts)
    throw std::invalid_argument("facet surface " + label + ": the law " +
                                law.law + " attracts across gaps");
}

Vec3 FacetBoundary::point_of(std::size_t k) const
{
  return point_at(surface, contact_points.point[k]);
}

Mat3 FacetBoundary::spread_of(std::size_t k) const
{
  Mat3 sum = Mat3::Zero();
  const FacetContactPoint &contact_point = contact_points.point[k];
  const Vec3 &force = batch.load[k].force, point = point_of(k);
  for_loads(surface, contact_point, force,
            [&](std::size_t vertex, const Vec3 &part)
            { sum += part * (surface.position[vertex] - point).transpose(); });
  return sum;
}

double FacetBoundary::speed() const
{
  double square = 0., check = 0.; // a maximum passes over NaN, a sum does not
  for (const Vec3 &velocity : surface.velocity)
  {
    square = std::max(square, velocity.squaredNorm());
    check += 0. * velocity.squaredNorm();
  }
  if (!std::isfinite(check))
    throw std::runtime_error("a vertex of a boundary surface has a velocity "
                             "that is not a finite number: the step of the "
                             "boundary is too long");
  return std::sqrt(square);
}

void FacetBoundary::find_candidates(const BoundarySearch &all)
{
  ContactPointSearchInput input = all.points;
  const ParticleSystem &particles = input.context.particles;
  const EngineParameters &parameters = input.context.parameters;
  input.layout = wall_layout(parameters, material, particles);
  WallSearch search{input.layout, parameters.geometry.wall_geometry, all.skin};
  if (!follows_surfaces(input.context))
  {
    rebuild_facets(particles, surface, search, near, contact_points.point,
                   batch, all.retired);
    return;
  }
  // Overlaps with a wall that was not there before count in full.
  input.is_first |= std::exchange(was_searched, true) == 0;
  input.skin = search_skin * all.least_radius;
  if (all.deforming_left < 0.)
    all.deforming_left = notice_share * input.skin;
  input.notice = all.deforming_left;
  search.skin = input.skin;
  search.reach = gathering_reach;
  if (all.is_on_any_rank(!watch.covers(particles, surface, input.skin)))
  {
    near = near_facets(particles, surface, search);
    watch.start(particles, surface, near, search);
  }
  all.events +=
      renew_facets(input, {mesh(), near, contact_points, near_particles, watch},
                   batch, all.retired);
}

ForceSum FacetBoundary::meet(const ForceContext &context)
{
  if (follows_surfaces(context))
    return relocate_on_facets(
        context,
        {mesh(), contact_points, context.deforming_path, rows, overlap}, batch);
  find_facets(context, mesh(), batch, near, contact_points.point, rows, extra);
  return {};
}

Walls FacetBoundary::walls(const ForceContext &context)
{
  if (!follows_surfaces(context))
    return {material, rows, {}, extra, {}};
  return {material,
          rows,
          overlap,
          {},
          [this](const ForceContext &still, std::size_t k)
          {
            relocate_again(
                still,
                {mesh(), contact_points, still.deforming_path, rows, overlap},
                batch, k);
          }};
}

BoundarySums FacetBoundary::sum_loads(const SumGrid &grid)
{
  load_spacing = load_spacing_of(grid, batch);
  load_counts.assign(3 * surface.load.size(), 0);
  for (std::size_t k = 0; k < batch.size(); ++k)
  {
    if (batch.load[k].force.isZero(0.))
      continue; // it may never have met anything
    for_loads(surface, contact_points.point[k], batch.load[k].force,
              [this](std::size_t vertex, const Vec3 &part)
              {
                for (std::size_t d = 0; d < 3; ++d)
                  add_count(part[static_cast<Eigen::Index>(d)] / load_spacing,
                            load_counts[3 * vertex + d]);
              });
  }
  return {{}, load_counts};
}

void FacetBoundary::apply_loads(double time_step)
{
  for (std::size_t v = 0; v < surface.load.size(); ++v)
    for (std::size_t d = 0; d < 3; ++d)
      surface.load[v][static_cast<Eigen::Index>(d)] =
          load_spacing * static_cast<double>(-load_counts[3 * v + d]);
  double power = 0.;
  for (std::size_t v = 0; v < surface.load.size(); ++v)
  {
    const Vec3 mean = 0.5 * (load_before[v] + surface.load[v]);
    power += mean.dot(surface.velocity[v]);
    impulse[v] += time_step * mean;
  }
  work_done -= power * time_step;
  load_before = surface.load;
}

void FacetBoundary::pack_parts(std::ostream &out) const
{
  const auto put = [&out](const auto &column) { write_column(out, column); };
  write_name(out, label);
  write_value(out, number);
  visit_surface(surface, put);
  FacetCandidates::visit(near, put);
  put(near_particles);
  FacetMotion::visit(watch, put);
  put(impulse);
  put(load_before);
  write_contact_points(out, contact_points);
  write_value(out, work_done);
  write_value(out, was_searched);
}

void FacetBoundary::unpack_parts(std::istream &in)
{
  const auto get = [&in](auto &column) { read_column(in, column); };
  label = read_name(in);
  read_value(in, number);
  visit_surface(surface, get);
  topology = FacetTopology(surface);
  FacetCandidates::visit(near, get);
  get(near_particles);
  FacetMotion::visit(watch, get);
  get(impulse);
  get(load_before);
  read_contact_points(in, contact_points);
  read_value(in, work_done);
  read_value(in, was_searched);
}
} // namespace dem
