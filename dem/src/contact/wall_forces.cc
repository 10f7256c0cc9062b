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
  const HertzPrefactors unit =
      unit_prefactors(owner.context.elasticity.on_plate(0));
  task.normal_factor = unit.normal;
  task.shear_factor = unit.tangential;
  task.is_radial =
      task.reads_surface &&
      traits(owner.context.parameters.geometry.wall_geometry).is_along_branch;
  task.walls = reinterpret_cast<const double *>(walls.rows.data());
  task.wall_overlap = walls.overlap.data();
  task.wall_extra = walls.extra.data();
  return task;
}

kernel::Loop wall_loop(const Walls &walls, const ContactBatch &batch)
{
  const kernel::Loops &loops = batch.layout.law.entry().loops();
  if (!batch.layout.has_contact_points)
    return loops.walls;
  return required(walls.overlap.empty() ? loops.surface_walls
                                        : loops.followed_walls,
                  batch.layout.law.entry());
}
} // namespace

BatchLayout wall_layout(const EngineParameters &parameters,
                        const WallMaterial &wall,
                        const ParticleSystem &particles)
{
  BatchLayout layout;
  layout.law = law_of(wall);
  const bool scales = layout.law.entry().scales_with_curvature;
  layout.has_attraction = layout.law.entry().attracts;
  layout.has_rolling = wall.rolling_friction > 0.;
  const GeometryTraits geometry = traits(parameters.geometry.wall_geometry);
  layout.has_damage =
      particles.has_shapes && may_break(parameters.breakage, geometry);
  layout.has_reversal =
      layout.has_damage && parameters.breakage.needs_reversal();
  layout.has_peak = layout.has_damage && parameters.breakage.repetitions > 1.;
  layout.has_sides =
      layout.has_damage ||
      (particles.has_shapes && (geometry.reads_shape || scales)) ||
      (particles.has_materials && scales);
  layout.has_prefactors = layout.has_sides && scales;
  layout.has_contact_points =
      particles.has_shapes && geometry.has_common_normal;
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
  if (walls.relocate)
    walls.relocate(context, k);
  return run_still(context, batch, k, wall_loop(walls, batch),
                   [&walls](SurfaceOwner &owner)
                   {
                     owner.walls = walls.rows;
                     return wall_task(owner, walls);
                   });
}
} // namespace dem
