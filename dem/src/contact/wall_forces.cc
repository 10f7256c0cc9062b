#include "surfaces.h"

#include <dem/contact/forces.h>

namespace dem
{
namespace
{
static_assert(sizeof(WallRow) == kernel::wall_row * sizeof(double));

kernel::Task wall_task(SurfaceOwner &owner, const Walls &walls)
{
  const WallMaterial &wall = walls.material;
  kernel::Task task = make_task(owner, coefficients_of(wall));
  task.is_hertz = wall.law == WallLaw::hertz;
  const HertzPrefactors unit =
      task.is_hertz ? unit_prefactors(owner.context.elasticity.on_plate(0))
                    : HertzPrefactors{};
  task.normal_factor = task.is_hertz ? unit.normal : wall.normal_stiffness;
  task.shear_factor = task.is_hertz ? unit.tangential : wall.shear_stiffness;
  task.is_radial =
      task.reads_surface && owner.context.parameters.geometry.wall_geometry ==
                                ContactGeometry::radial;
  task.walls = reinterpret_cast<const double *>(walls.rows.data());
  task.wall_overlap = walls.overlap.data();
  task.wall_extra = walls.extra.data();
  return task;
}

kernel::Loop wall_loop(const Walls &walls, const ContactBatch &batch)
{
  if (!batch.layout.has_contact_points)
    return kernel::loops().walls;
  return walls.overlap.empty() ? kernel::loops().surface_walls
                               : kernel::loops().placed_walls;
}
} // namespace

BatchLayout wall_layout(const EngineParameters &parameters,
                        const WallMaterial &wall,
                        const ParticleSystem &particles)
{
  BatchLayout layout;
  layout.is_hertz = wall.law == WallLaw::hertz;
  layout.normal_stiffness = layout.is_hertz ? 0. : wall.normal_stiffness;
  layout.has_rolling = wall.rolling_friction > 0.;
  const ContactGeometry geometry = parameters.geometry.wall_geometry;
  layout.has_damage =
      particles.has_shapes && may_break(parameters.breakage, geometry);
  layout.has_turn = layout.has_damage && parameters.breakage.needs_turn();
  layout.has_peak = layout.has_damage && parameters.breakage.repetitions > 1.;
  layout.has_sides =
      layout.has_damage ||
      (particles.has_shapes &&
       (geometry != ContactGeometry::sphere || layout.is_hertz)) ||
      (particles.has_materials && layout.is_hertz);
  layout.has_contact_points =
      particles.has_shapes && geometry == ContactGeometry::surface;
  return layout;
}

ForceSum wall_forces(const ForceContext &context, const Walls &walls,
                     ContactBatch &batch, std::vector<RangeSum> &ranges)
{
  SurfaceOwner owner{context, batch, walls.rows};
  return run_loop(wall_loop(walls, batch), wall_task(owner, walls), owner,
                  ranges);
}

double reset_wall(const ForceContext &context, const Walls &walls,
                  ContactBatch &batch, std::size_t k)
{
  if (walls.replace)
    walls.replace(k);
  return run_still(context, batch, k, wall_loop(walls, batch),
                   [&walls](SurfaceOwner &owner)
                   {
                     owner.walls = walls.rows;
                     return wall_task(owner, walls);
                   });
}

void plane_rows(const std::vector<Plane> &planes, std::vector<WallRow> &rows)
{
  rows.resize(planes.size());
  for (std::size_t p = 0; p < planes.size(); ++p)
  {
    const Plane &plane = planes[p];
    rows[p] = {plane.point,    -plane.normal, plane.velocity,
               plane.velocity, -plane.normal, 0.};
  }
}
} // namespace dem
