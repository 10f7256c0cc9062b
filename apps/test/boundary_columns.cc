#include "test/boundary_columns.h"

#include "specimen/mesh_walls.h"

#include <dem/engine_boundaries.h>
#include <dem/measure/boundary_load.h>
#include <dem/measure/totals.h>

#include <algorithm>

namespace spall
{
namespace
{
using Quantities = std::vector<std::pair<std::string, double>>;

void add_load(const std::string &name, const dem::WallLoad &load,
              Quantities &all)
{
  for (Eigen::Index d = 0; d < 3; ++d)
    all.emplace_back(name + "_force_" + "xyz"[d] + "_N", load.force[d] + 0.);
  for (Eigen::Index d = 0; d < 3; ++d)
    all.emplace_back(name + "_moment_" + "xyz"[d] + "_Nm", load.moment[d] + 0.);
}

void add_losses(const std::string &name, double friction, double mass,
                Quantities &all)
{
  all.emplace_back(name + "_friction_J", friction + 0.); // no -0
  all.emplace_back(name + "_removed_mass_kg", mass);
}

/// Of a boundary that may not be there yet.
double friction_on(const dem::Engine &engine, const dem::Boundary *boundary)
{
  return boundary ? dem::total_friction(engine, *boundary) : 0.;
}

const dem::FacetBoundary *surface_of(const dem::Engine &engine,
                                     const std::string &label)
{
  for (const dem::FacetBoundary &surface : dem::surfaces(engine))
    if (surface.label == label)
      return &surface;
  return nullptr;
}

void add_plane(const dem::Engine &engine, const NamedBoundary &plane,
               const dem::Vec3 &about, const RemovedMass &removed,
               Quantities &all)
{
  const bool is_there = plane.number < dem::planes(engine).size();
  add_load(plane.name,
           is_there ? dem::load_on_plane(engine, plane.number, about)
                    : dem::WallLoad{},
           all);
  all.emplace_back(plane.name + "_removed_mass_kg",
                   removed.on(1, static_cast<std::int64_t>(plane.number)));
}

void add_surface(const dem::Engine &engine, const std::string &name,
                 const dem::Vec3 &about, const RemovedMass &removed,
                 Quantities &all)
{
  const dem::FacetBoundary *surface = surface_of(engine, name);
  add_load(name,
           surface ? dem::load_on(surface->surface, about) : dem::WallLoad{},
           all);
  add_losses(name, friction_on(engine, surface),
             surface ? removed.on(2, surface->event_other(0)) : 0., all);
}
} // namespace

Quantities boundary_quantities(const dem::Engine &engine,
                               std::span<const NamedBoundary> named,
                               const dem::Vec3 &about,
                               const RemovedMass &removed)
{
  Quantities all;
  for (const NamedBoundary &one : named)
    switch (one.kind)
    {
    case BoundaryKind::plane:
      add_plane(engine, one, about, removed, all);
      break;
    case BoundaryKind::drum:
      add_load(one.name, dem::load_on_drum(engine, about), all);
      add_losses(
          one.name,
          friction_on(engine, dem::find_boundary<dem::DrumBoundary>(engine)),
          removed.on(3, -1), all);
      break;
    case BoundaryKind::surface:
      add_surface(engine, one.name, about, removed, all);
    }
  if (std::ranges::count(named, BoundaryKind::plane, &NamedBoundary::kind) > 0)
    all.emplace_back(
        "planes_friction_J",
        friction_on(engine, dem::find_boundary<dem::PlaneBoundary>(engine)) +
            0.);
  for (const auto &[name, value] : wall_quantities(engine))
    all.emplace_back(name, value);
  for (const dem::MeshWall &wall : dem::mesh_walls(engine))
    all.emplace_back(wall.label + "_removed_mass_kg",
                     removed.on(wall.event_kind(), wall.event_other(0)));
  return all;
}
} // namespace spall
