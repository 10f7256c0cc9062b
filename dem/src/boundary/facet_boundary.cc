#include <dem/binary.h>
#include <dem/boundary/facet_boundary.h>
#include <dem/boundary/followed_walls.h>
#include <dem/boundary/renumber.h>
#include <dem/boundary/wall_candidates.h>
#include <dem/boundary/wall_point_lists.h>

#include <algorithm>
#include <cmath>
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

template <class Candidates, class Visit>
void visit_candidates(Candidates &candidates, const Visit &visit)
{
  visit(candidates.particle);
  visit(candidates.row_start);
  visit(candidates.triangle);
  visit(candidates.triangle_reactivation);
  visit(candidates.reactivation);
}

/// What a FacetContactPoint has beside the vertices that carry it.
struct ContactPointHead
{
  std::int64_t triangle = -1;
  std::array<double, 3> weight{};
  Vec3 normal = Vec3::Zero();
  std::int64_t walls = 1;
  double extra = 0.;
  std::int64_t n_shares = 0;
};

/// Heads in one column, the shares of all contact_points in another.
void save_contact_points(std::ostream &out,
                         const std::vector<FacetContactPoint> &contact_points)
{
  std::vector<ContactPointHead> heads;
  std::vector<VertexShare> shares;
  heads.reserve(contact_points.size());
  for (const FacetContactPoint &contact_point : contact_points)
  {
    heads.push_back(
        {contact_point.triangle, contact_point.weight, contact_point.normal,
         contact_point.shares.walls, contact_point.shares.extra,
         static_cast<std::int64_t>(contact_point.shares.of.size())});
    shares.insert(shares.end(), contact_point.shares.of.begin(),
                  contact_point.shares.of.end());
  }
  write_column(out, heads);
  write_column(out, shares);
}

void restore_contact_points(std::istream &in,
                            std::vector<FacetContactPoint> &contact_points)
{
  std::vector<ContactPointHead> heads;
  std::vector<VertexShare> shares;
  read_column(in, heads);
  read_column(in, shares);
  contact_points.resize(heads.size());
  auto next = shares.cbegin();
  for (std::size_t k = 0; k < heads.size(); ++k)
  {
    const ContactPointHead &head = heads[k];
    if (head.n_shares < 0 || head.n_shares > shares.cend() - next)
      throw std::runtime_error("checkpoint is damaged");
    FacetContactPoint &contact_point = contact_points[k];
    contact_point.triangle = head.triangle;
    contact_point.weight = head.weight;
    contact_point.normal = head.normal;
    contact_point.shares.walls = head.walls;
    contact_point.shares.extra = head.extra;
    contact_point.shares.of.assign(next, next + head.n_shares);
    next += head.n_shares;
  }
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
  return point_at(surface, candidates.contact_point[k]);
}

Mat3 FacetBoundary::spread_of(std::size_t k) const
{
  Mat3 sum = Mat3::Zero();
  const FacetContactPoint &contact_point = candidates.contact_point[k];
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
                             "that is no finite number: the step of the "
                             "boundary is too long");
  return std::sqrt(square);
}

void FacetBoundary::gather(const ForceContext &context,
                           const WallSearch &search)
{
  FacetCandidates near = near_facets(context.particles, surface, search);
  near.contact_point = std::move(candidates.contact_point);
  near.reactivation = std::move(candidates.reactivation);
  candidates = std::move(near);
  watch.start(context.particles, surface, candidates, search);
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
    rebuild_facets(particles, surface, search, candidates, batch, all.retired);
    return;
  }
  input.skin = search_skin * particles.smallest_radius();
  if (all.deforming_left < 0.)
    all.deforming_left = notice_share * input.skin;
  input.notice = all.deforming_left;
  search.skin = input.skin;
  search.reach = gathering_reach;
  if (!watch.covers(particles, surface, input.skin))
    gather(input.context, search);
  all.events += renew_facets(input, {mesh(), candidates, near_particles, watch},
                             batch, all.retired);
}

void FacetBoundary::renumber(const std::vector<std::int32_t> &new_row,
                             bool follows_surfaces)
{
  if (!follows_surfaces)
  {
    renumber_facets(new_row, candidates, batch);
    return;
  }
  renumber_facet_contacts(new_row, candidates, batch);
  renumber_candidates(new_row, near_particles);
  watch = {}; // rows take other numbers
}

ForceSum FacetBoundary::meet(const ForceContext &context)
{
  if (follows_surfaces(context))
    return relocate_on_facets(
        context, {mesh(), candidates, context.deforming_path, rows, overlap},
        batch);
  find_facets(context, mesh(), batch, candidates, rows, extra);
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
                {mesh(), candidates, still.deforming_path, rows, overlap},
                batch, k);
          }};
}

void FacetBoundary::apply_loads(double time_step)
{
  load_surface(candidates, batch, surface);
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
  visit_candidates(candidates, put);
  put(near_particles);
  FacetMotion::visit(watch, put);
  put(impulse);
  put(load_before);
  save_contact_points(out, candidates.contact_point);
  write_value(out, work_done);
}

void FacetBoundary::unpack_parts(std::istream &in)
{
  const auto get = [&in](auto &column) { read_column(in, column); };
  label = read_name(in);
  read_value(in, number);
  visit_surface(surface, get);
  topology = FacetTopology(surface);
  visit_candidates(candidates, get);
  get(near_particles);
  FacetMotion::visit(watch, get);
  get(impulse);
  get(load_before);
  restore_contact_points(in, candidates.contact_point);
  read_value(in, work_done);
}
} // namespace dem
