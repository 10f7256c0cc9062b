#include <dem/engine.h>
#include <dem/io/binary.h>

#include <algorithm>

namespace dem
{
namespace
{
constexpr std::int32_t is_sphere = -1, is_own = -2;

using Library = std::vector<std::shared_ptr<const Coefficients>>;

void save_body(std::ostream &out, const Body &body, const Library &library)
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
  for (const double value : {body.scale, body.volume, body.inscribed_radius,
                             body.circumscribed_radius, body.max_slope})
    write_value(out, value);
}

void restore_body(std::istream &in, Body &body, const Library &library)
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
  for (double *value : {&body.scale, &body.volume, &body.inscribed_radius,
                        &body.circumscribed_radius, &body.max_slope})
    read_value(in, *value);
}

/// Calls visit(column) for every plain column, in a fixed order.
template <class Columns, class Visit>
void visit_particles(Columns &stones, const Visit &visit)
{
  visit(stones.id);
  visit(stones.position);
  visit(stones.velocity);
  visit(stones.spin);
  visit(stones.orientation);
  visit(stones.rotation);
  visit(stones.radius);
  visit(stones.mass);
  visit(stones.inertia);
  visit(stones.initial_mass);
  visit(stones.is_breakable);
  visit(stones.force);
  visit(stones.moment);
}

template <class Batch, class Visit>
void visit_batch(Batch &batch, const Visit &visit)
{
  visit(batch.a);
  visit(batch.b);
  visit(batch.side_a);
  visit(batch.side_b);
  visit(batch.prefactors);
  visit(batch.wake);
  visit(batch.twist);
  visit(batch.history);
  visit(batch.lost);
  visit(batch.load);
  visit(batch.normal);
  visit(batch.event);
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

template <class Candidates, class Visit>
void visit_candidates(Candidates &candidates, const Visit &visit)
{
  visit(candidates.stone);
  visit(candidates.row_start);
  visit(candidates.triangle);
  visit(candidates.spot);
  visit(candidates.wake);
}
} // namespace

void Engine::save(std::ostream &out, const Library &library) const
{
  const auto put = [&out](const auto &column) { write_column(out, column); };
  visit_particles(stones, put);
  for (const Body &body : stones.body)
    save_body(out, body, library);
  put(walls);
  visit_surface(facet_surface, put);
  for (const ContactBatch *batch : {&pair_batch, &plane_batch, &facet_batch})
    visit_batch(*batch, put);
  visit_candidates(facet_candidates, put);
  put(pair_row);
  put(pair_entry);
  put(damped);
  put(lifted);
  put(surface_load_before);
  write_value(out, settings.stone.friction);
  write_value(out, settings.local_damping);
  write_value(out, settings.breakage.is_active);
  write_value(out, lists_are_stale);
  for (const double value :
       {margin_left, steepest, now, travelled, released, fractured, pushed})
    write_value(out, value);
  for (const std::int64_t count : {step_count, rebuild_count, event_count})
    write_value(out, count);
  write_value(out, refused_count);
  write_value(out, retired);
}

void Engine::restore(std::istream &in, const Library &library)
{
  const auto get = [&in](auto &column) { read_column(in, column); };
  visit_particles(stones, get);
  stones.body.resize(stones.id.size());
  for (Body &body : stones.body)
    restore_body(in, body, library);
  get(walls);
  visit_surface(facet_surface, get);
  topology = facet_surface.triangles.empty()
                 ? nullptr
                 : std::make_unique<FacetTopology>(facet_surface);
  for (ContactBatch *batch : {&pair_batch, &plane_batch, &facet_batch})
    visit_batch(*batch, get);
  visit_candidates(facet_candidates, get);
  get(pair_row);
  get(pair_entry);
  get(damped);
  get(lifted);
  get(surface_load_before);
  read_value(in, settings.stone.friction);
  read_value(in, settings.local_damping);
  read_value(in, settings.breakage.is_active);
  read_value(in, lists_are_stale);
  for (double *value : {&margin_left, &steepest, &now, &travelled, &released,
                        &fractured, &pushed})
    read_value(in, *value);
  for (std::int64_t *count : {&step_count, &rebuild_count, &event_count})
    read_value(in, *count);
  read_value(in, refused_count);
  read_value(in, retired);
  events.clear();
}
} // namespace dem
