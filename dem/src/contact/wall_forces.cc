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
  task.normal_factor = wall.normal_stiffness;
  task.shear_factor = wall.shear_stiffness;
  task.is_radial =
      task.reads_surface && owner.context.parameters.geometry.wall_geometry ==
                                ContactGeometry::radial;
  task.walls = reinterpret_cast<const double *>(walls.rows.data());
  return task;
}
} // namespace

BatchLayout wall_layout(const EngineParameters &parameters,
                        const WallMaterial &wall, const Particles &particles)
{
  BatchLayout layout;
  layout.has_rolling = wall.rolling_friction > 0.;
  layout.has_damage =
      particles.has_shapes &&
      may_break(parameters.breakage, parameters.geometry.wall_geometry);
  layout.has_level = layout.has_damage && parameters.breakage.needs_level();
  layout.has_sides = layout.has_damage || (particles.has_shapes &&
                                           parameters.geometry.wall_geometry ==
                                               ContactGeometry::radial);
  return layout;
}

ForceSum wall_forces(const ForceContext &context, const Walls &walls,
                     ContactBatch &batch, std::vector<RangeSum> &ranges)
{
  SurfaceOwner owner{context, batch};
  return run_loop(kernel::loops().walls, wall_task(owner, walls), batch.size(),
                  ranges);
}

double reset_wall(const ForceContext &context, const Walls &walls,
                  ContactBatch &batch, std::size_t k)
{
  return run_still(context, batch, k, kernel::loops().walls,
                   [&walls](SurfaceOwner &owner)
                   { return wall_task(owner, walls); });
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
