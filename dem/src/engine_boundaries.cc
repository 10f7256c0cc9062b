// The boundaries of the engine: their lists, where particles meet them, their
// loads and work.
#include "engine_state.h"

#include <dem/engine_boundaries.h>
#include <dem/parallel/rank_sums.h>

#include <algorithm>
#include <array>
#include <utility>

namespace dem
{
bool EngineState::follows_walls() const
{
  return system.has_shapes &&
         traits(settings.geometry.wall_geometry).has_common_normal;
}

void EngineState::find_boundary_candidates(bool of_deforming_alone)
{
  const ForceContext still = context(0.);
  const BoundarySearch search{
      contact_point_search(still, {}),
      [this](bool own) { return any_of_ranks(distribution.ranks(), own); },
      least_radius,
      schedule.skin.width,
      schedule.rigid_path,
      schedule.deforming_left,
      lost,
      contact_points.events};
  for (const auto &boundary : walls)
    if (!of_deforming_alone || boundary->deforms())
      boundary->find_candidates(search);
}

void EngineState::meet_walls(double time_step)
{
  const ForceContext moved = context(time_step);
  for (const auto &boundary : walls)
  {
    ForceSum sum = boundary->meet(moved);
    if (boundary->deforms() && follows_walls())
    {
      if (std::exchange(sum.has_displaced, false))
        schedule.note_displaced_on_deforming();
    }
    count_contact_point_events(sum);
  }
}

void EngineState::move_boundaries(double time_step)
{
  for (const auto &boundary : walls)
    boundary->move(time_step);
}

void EngineState::move_cell(double time_step)
{
  book_cell(time_step);
  system.cell.length += time_step * system.cell.rate;
}

/// Half a step with the forces as they are.
void EngineState::book_cell(double time_step)
{
  system.cell.work += 0.5 * time_step * system.cell.force.dot(system.cell.rate);
}

/// The fastest image against its particle, or another image [m/s].
double EngineState::cell_speed() const
{
  return system.cell.is_there() ? system.cell.rate.cwiseAbs().dot(image_span)
                                : 0.;
}

void EngineState::load_boundaries(double time_step)
{
  sum_loads();
  if (has_large_forces)
  {
    // Some sums may not be exact: again, with a larger spacing.
    std::array largest{largest_force};
    distribution.ranks().max(largest);
    note_forces(largest[0]);
    add_loads_again();
    sum_loads();
  }
  book_cell(time_step);
  for (const auto &boundary : walls)
    boundary->apply_loads(time_step);
}

/// Loads of boundaries that are sums over many contacts.
void EngineState::sum_loads()
{
  has_large_forces = largest_force > grid.largest_force();
  if (distribution.is_shared())
    share_loads();
  else
    for (const auto &boundary : walls)
      boundary->sum_loads(grid);
}

PlaneBoundary &plane_boundary(Engine &engine)
{
  if (auto *there = find_boundary<PlaneBoundary>(engine))
    return *there;
  return static_cast<PlaneBoundary &>(engine.add_boundary(
      std::make_unique<PlaneBoundary>(engine.parameters().wall)));
}

std::vector<Plane> &planes(Engine &engine)
{
  return plane_boundary(engine).planes;
}

const std::vector<Plane> &planes(const Engine &engine)
{
  static const std::vector<Plane> none;
  const auto *there = find_boundary<PlaneBoundary>(engine);
  return there ? there->planes : none;
}

std::size_t add_plane(Engine &engine, const Vec3 &point, const Vec3 &normal)
{
  planes(engine).push_back({point, normal.normalized()});
  engine.lists_changed();
  return planes(engine).size() - 1;
}

void deactivate_plane(Engine &engine, std::size_t plane)
{
  planes(engine)[plane].is_active = false;
  planes(engine)[plane].force = Vec3::Zero();
  engine.lists_changed();
}

void place_plane(Engine &engine, std::size_t plane, const Vec3 &point)
{
  planes(engine)[plane].point = point;
  planes(engine)[plane].velocity = Vec3::Zero();
  planes(engine)[plane].is_active = true;
  engine.lists_changed();
}

const ContactBatch &on_planes(const Engine &engine)
{
  static const ContactBatch none;
  const auto *there = find_boundary<PlaneBoundary>(engine);
  return there ? there->batch : none;
}

void set_drum(Engine &engine, const Drum &drum)
{
  auto *there = find_boundary<DrumBoundary>(engine);
  if (!there)
    there = static_cast<DrumBoundary *>(&engine.add_boundary(
        std::make_unique<DrumBoundary>(engine.parameters().wall)));
  there->set_drum(drum);
  engine.lists_changed();
}

Drum &drum(Engine &engine)
{
  auto *there = find_boundary<DrumBoundary>(engine);
  if (!there)
    throw std::logic_error("engine: there is no drum");
  return there->drum;
}

const Drum &drum(const Engine &engine)
{
  static const Drum none;
  const auto *there = find_boundary<DrumBoundary>(engine);
  return there ? there->drum : none;
}

const ContactBatch &on_drum(const Engine &engine)
{
  static const ContactBatch none;
  const auto *there = find_boundary<DrumBoundary>(engine);
  return there ? there->batch : none;
}

namespace
{
/// The boundaries of a class, but of none that is derived from it.
template <class Kind, class Engine>
auto all_of_kind(Engine &engine)
{
  std::vector<std::reference_wrapper<Kind>> all;
  for (const auto &boundary : engine.boundaries())
    if (boundary->kind() == Kind::kind_name)
      all.emplace_back(static_cast<Kind &>(*boundary));
  return all;
}

template <class Walls>
void require_free_label(const Walls &there, const std::string &label,
                        const std::string &what)
{
  for (const FacetBoundary &other : there)
    if (other.label == label)
      throw std::invalid_argument(what + ": there are two of the name " +
                                  label);
}
} // namespace

std::vector<std::reference_wrapper<FacetBoundary>> surfaces(Engine &engine)
{
  return all_of_kind<FacetBoundary>(engine);
}

std::vector<std::reference_wrapper<const FacetBoundary>>
surfaces(const Engine &engine)
{
  return all_of_kind<const FacetBoundary>(engine);
}

std::vector<std::reference_wrapper<const FacetBoundary>>
all_facets(const Engine &engine)
{
  std::vector<std::reference_wrapper<const FacetBoundary>> all;
  for (const auto &boundary : engine.boundaries())
    if (const auto *facets = dynamic_cast<const FacetBoundary *>(&*boundary))
      all.emplace_back(*facets);
  return all;
}

std::vector<std::reference_wrapper<const MeshWall>>
mesh_walls(const Engine &engine)
{
  return all_of_kind<const MeshWall>(engine);
}
std::vector<std::reference_wrapper<MeshWall>> mesh_walls(Engine &engine)
{
  return all_of_kind<MeshWall>(engine);
}

std::size_t add_mesh_wall(Engine &engine, const std::string &label,
                          const WallMaterial &material, FacetSurface surface,
                          const WallMotion &motion)
{
  const auto there = mesh_walls(engine);
  require_free_label(there, label, "mesh wall");
  engine.add_boundary(
      std::make_unique<MeshWall>(label, static_cast<std::int64_t>(there.size()),
                                 material, std::move(surface), motion));
  return there.size();
}

std::size_t add_surface(Engine &engine, const std::string &label,
                        const WallMaterial &material, FacetSurface surface)
{
  const auto there = surfaces(engine);
  require_free_label(there, label, "facet surface");
  engine.add_boundary(std::make_unique<FacetBoundary>(
      label, static_cast<std::int64_t>(there.size()), material,
      std::move(surface)));
  return there.size();
}

void attach_surface(Engine &engine, FacetSurface surface)
{
  add_surface(engine, "surface", engine.parameters().surface,
              std::move(surface));
}
} // namespace dem
