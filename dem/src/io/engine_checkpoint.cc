#include <dem/engine.h>
#include <dem/io/binary.h>

#include <algorithm>
#include <utility>

namespace dem
{
namespace
{
constexpr std::int32_t is_sphere = -1, is_own = -2;

using Library = std::vector<std::shared_ptr<const Coefficients>>;

void save_body(std::ostream &out, const ParticleShape &body,
               const Library &library)
{
  std::int32_t place = is_sphere;
  if (body.series)
  {
    const auto found = std::find(library.begin(), library.end(), body.series);
    place = found == library.end()
                ? is_own
                : static_cast<std::int32_t>(found - library.begin());
  }
  write_value(out, place);
  if (place == is_own)
    write_column(out, *body.series);
  for (const double value :
       {body.scale, body.volume, body.inscribed_radius, body.corner_radius,
        body.circumscribed_radius, body.least_radius, body.max_slope})
    write_value(out, value);
  write_value(out, body.gyration);
  write_value(out, body.principal.coeffs());
}

void restore_body(std::istream &in, ParticleShape &body, const Library &library)
{
  std::int32_t place = is_sphere;
  read_value(in, place);
  body.series.reset();
  if (place == is_own)
  {
    Coefficients own;
    read_column(in, own);
    body.series = std::make_shared<const Coefficients>(std::move(own));
  }
  else if (place != is_sphere)
  {
    if (place < 0 || static_cast<std::size_t>(place) >= library.size())
      throw std::runtime_error("checkpoint names a shape that is not there");
    body.series = library[static_cast<std::size_t>(place)];
  }
  for (double *value :
       {&body.scale, &body.volume, &body.inscribed_radius, &body.corner_radius,
        &body.circumscribed_radius, &body.least_radius, &body.max_slope})
    read_value(in, *value);
  read_value(in, body.gyration);
  read_value(in, body.principal.coeffs());
}

template <class Surface, class Visit>
void visit_surface(Surface &surface, const Visit &visit)
{
  visit(surface.triangles);
  visit(surface.position);
  visit(surface.velocity);
  visit(surface.mass);
  visit(surface.load);
}

void save_name(std::ostream &out, const std::string &name)
{
  write_column(out, std::vector<char>(name.begin(), name.end()));
}

std::string read_name(std::istream &in)
{
  std::vector<char> name;
  read_column(in, name);
  return {name.begin(), name.end()};
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
template <class Batch, class Visit>
void visit_batch(Batch &batch, const Visit &visit)
{
  ContactBatch::visit(
      batch.layout, [&visit](bool, auto &column) { visit(column); }, batch);
}

/// One by one: between the fields of the struct there may be anything.
template <class Layout, class Visit>
void visit_layout(Layout &layout, const Visit &visit)
{
  visit(layout.normal_stiffness);
  visit(layout.is_hertz);
  visit(layout.has_rolling);
  visit(layout.has_sides);
  visit(layout.has_partners);
  visit(layout.has_damage);
  visit(layout.has_turn);
  visit(layout.has_peak);
  visit(layout.has_contact_points);
}

void save_batch(std::ostream &out, const ContactBatch &batch)
{
  visit_layout(batch.layout,
               [&out](const auto &field) { write_value(out, field); });
  write_value(out, batch.size());
  visit_batch(batch, [&out](const auto &column) { write_column(out, column); });
}

void restore_batch(std::istream &in, ContactBatch &batch)
{
  visit_layout(batch.layout, [&in](auto &field) { read_value(in, field); });
  std::size_t n = 0;
  read_value(in, n);
  batch.set_size(n);
  visit_batch(batch, [&in](auto &column) { read_column(in, column); });
}

template <class Facets, class Visit>
void visit_contacts(Facets &facets, const Visit &visit)
{
  visit_candidates(facets.candidates, visit);
  visit(facets.near_particles);
  FacetMotion::visit(facets.watch, visit);
  visit(facets.impulse);
  visit(facets.load_before);
}

void save_facets(std::ostream &out, const SurfaceContacts &facets)
{
  const auto put = [&out](const auto &column) { write_column(out, column); };
  save_name(out, facets.name);
  write_value(out, facets.material);
  visit_surface(facets.surface, put);
  save_batch(out, facets.batch);
  visit_contacts(facets, put);
  save_contact_points(out, facets.candidates.contact_point);
  write_value(out, facets.work);
}

SurfaceContacts restore_facets(std::istream &in)
{
  const auto get = [&in](auto &column) { read_column(in, column); };
  const std::string name = read_name(in);
  WallMaterial material;
  read_value(in, material);
  FacetSurface surface;
  visit_surface(surface, get);
  SurfaceContacts facets(name, material, std::move(surface));
  restore_batch(in, facets.batch);
  visit_contacts(facets, get);
  restore_contact_points(in, facets.candidates.contact_point);
  read_value(in, facets.work);
  return facets;
}
} // namespace

template <class Self, class Visit>
void Engine::visit_state(Self &self, const Visit &visit)
{
  visit(self.settings.particle.friction);
  visit(self.settings.local_damping);
  visit(self.settings.geometry.refresh_tolerance);
  visit(self.settings.breakage.is_active);
  visit(self.settings.breakage.repetitions);
  visit(self.lists_are_stale);
  visit(self.places_are_stale);
  visit(self.margin);
  visit(self.steepest);
  visit(self.now);
  visit(self.travelled);
  visit(self.travelled_sorted);
  visit(self.released);
  visit(self.fractured);
  visit(self.step_count);
  visit(self.rebuild_count);
  visit(self.event_count);
  visit(self.refused_count);
  visit(self.lost);
  visit(self.overlap);
  visit(self.least_radius);
  visit(self.travel);
  visit(self.walls_travelled);
  visit(self.sheets_travelled);
  visit(self.facets_left);
  visit(self.facets_are_stale);
}

void Engine::save(std::ostream &out, const Library &library) const
{
  finish_kick();
  const auto put = [&out](const auto &column) { write_column(out, column); };
  ParticleSystem::visit(system, put);
  for (const ParticleShape &body : system.shape)
    save_body(out, body, library);
  put(walls);
  write_value(out, barrel);
  put(drum_walls);
  for (const ContactBatch *batch : {&pair_batch, &plane_batch, &drum_batch})
    save_batch(out, *batch);
  write_value(out, facet_surfaces.size());
  for (const SurfaceContacts &facets : facet_surfaces)
    save_facets(out, facets);
  put(work.damped);
  put(work.lifted);
  put(patches.factors);
  const auto put_value = [&out](const auto &value) { write_value(out, value); };
  visit_state(*this, put_value);
  ContactPointLists::visit(contact_points, put_value, put);
}

void Engine::restore(std::istream &in, const Library &library)
{
  pending_half_kick = 0.;
  const auto get = [&in](auto &column) { read_column(in, column); };
  ParticleSystem::visit(system, get);
  system.shape.resize(system.id.size());
  system.has_shapes = false;
  system.follows_surfaces = settings.geometry.follows_surfaces();
  system.has_materials =
      std::ranges::any_of(system.material, [](auto m) { return m != 0; });
  for (ParticleShape &body : system.shape)
  {
    restore_body(in, body, library);
    system.has_shapes |= body.series != nullptr;
  }
  system.renew_frames();
  get(walls);
  read_value(in, barrel);
  lifter = DrumLifter(barrel);
  get(drum_walls);
  for (ContactBatch *batch : {&pair_batch, &plane_batch, &drum_batch})
    restore_batch(in, *batch);
  std::size_t n_surfaces = 0;
  read_value(in, n_surfaces);
  facet_surfaces.clear();
  for (std::size_t s = 0; s < n_surfaces; ++s)
    facet_surfaces.push_back(restore_facets(in));
  pair_loads.prepare(pair_batch);
  pair_finder.forget();
  get(work.damped);
  get(work.lifted);
  get(patches.factors);
  const auto get_value = [&in](auto &value) { read_value(in, value); };
  visit_state(*this, get_value);
  ContactPointLists::visit(contact_points, get_value, get);
  events.clear();
}
} // namespace dem
