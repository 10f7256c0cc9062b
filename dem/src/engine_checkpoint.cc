#include "engine_state.h"

#include <dem/binary.h>
#include <dem/contact/batch_stream.h>
#include <dem/shape/shape_stream.h>

#include <algorithm>
#include <sstream>
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
  std::int32_t index = is_sphere;
  if (body.series)
  {
    const auto found = std::find(library.begin(), library.end(), body.series);
    index = found == library.end()
                ? is_own
                : static_cast<std::int32_t>(found - library.begin());
  }
  write_value(out, index);
  if (index == is_own)
    write_column(out, *body.series);
  write_measures(out, body);
}

void restore_body(std::istream &in, ParticleShape &body, const Library &library)
{
  std::int32_t index = is_sphere;
  read_value(in, index);
  body.series.reset();
  if (index == is_own)
  {
    Coefficients own;
    read_column(in, own);
    body.series = std::make_shared<const Coefficients>(std::move(own));
  }
  else if (index != is_sphere)
  {
    if (index < 0 || static_cast<std::size_t>(index) >= library.size())
      throw std::runtime_error("checkpoint names a shape that is not there");
    body.series = library[static_cast<std::size_t>(index)];
  }
  read_measures(in, body);
}
} // namespace

template <class Self, class Visit>
void EngineState::visit_state(Self &self, const Visit &visit)
{
  NeighborSchedule::visit(self.schedule, visit);
  visit(self.settings.particle.friction);
  visit(self.settings.local_damping);
  visit(self.settings.geometry.refresh_tolerance);
  visit(self.settings.breakage.is_active);
  visit(self.settings.breakage.repetitions);
  visit(self.steepest);
  visit(self.now);
  visit(self.path_at_sort);
  visit(self.released);
  visit(self.fractured);
  visit(self.step_count);
  visit(self.event_count);
  visit(self.refused_count);
  visit(self.grid);
  visit(self.grid_force);
  visit(self.recent_force);
  visit(self.lost);
  visit(self.overlap);
  visit(self.system.cell);
  visit(self.image_span);
  visit(self.least_radius);
  visit(self.largest_radius);
  visit(self.added_count);
}

void EngineState::copy_values_to(EngineState &copy) const
{
  std::stringstream values;
  visit_state(*this,
              [&values](const auto &value) { write_value(values, value); });
  visit_state(copy, [&values](auto &value) { read_value(values, value); });
}

void EngineState::save(std::ostream &out, const Library &library) const
{
  require_synchronized();
  const auto put = [&out](const auto &column) { write_column(out, column); };
  ParticleSystem::visit(system, put);
  for (const ParticleShape &body : system.shape)
    save_body(out, body, library);
  write_batch(out, pair_batch);
  write_value(out, walls.size());
  for (const auto &boundary : walls)
  {
    write_name(out, boundary->kind());
    boundary->pack(out);
  }
  put(work.damped);
  put(work.lifted);
  put(patches.factors);
  const auto put_value = [&out](const auto &value) { write_value(out, value); };
  visit_state(*this, put_value);
  ContactPointLists::visit(contact_points, put_value, put);
}

void EngineState::restore(std::istream &in, const Library &library)
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
  read_batch(in, pair_batch);
  std::size_t n_boundaries = 0;
  read_value(in, n_boundaries);
  walls.clear();
  for (std::size_t b = 0; b < n_boundaries; ++b)
  {
    walls.push_back(make_boundary(read_name(in)));
    walls.back()->unpack(in);
  }
  pair_loads.prepare(pair_batch);
  pair_finder.forget();
  get(work.damped);
  get(work.lifted);
  get(patches.factors);
  const auto get_value = [&in](auto &value) { read_value(in, value); };
  visit_state(*this, get_value);
  ContactPointLists::visit(contact_points, get_value, get);
  events.clear();
  deal_out();
}
} // namespace dem
