#include "surfaces.h"

#include <dem/contact/forces.h>

namespace dem
{
namespace
{
/// Prefactors of two balls: C_H = 4/3 E* sqrt(R), k_s / sqrt(delta) =
/// 8 G* sqrt(R) with 1/G* = sum (2 - nu_i) / G_i, from the elliptic solution of
/// a circle: A = B = 1 / (2 R), here for R = 1.
HertzPrefactors unit_prefactors(const PairElasticity &elasticity)
{
  return elliptic_table()(elasticity, {0.5, 0.5});
}

kernel::Task pair_task(SurfaceOwner &owner)
{
  const EngineParameters &parameters = owner.context.parameters;
  const StoneMaterial &stone = parameters.stone;
  kernel::Task task =
      make_task(owner, {stone.friction, stone.rolling_friction,
                        stone.normal_damping, stone.shear_damping});
  const HertzPrefactors prefactors = unit_prefactors(owner.context.elasticity);
  task.normal_factor = prefactors.normal;
  task.shear_factor = prefactors.tangential;
  task.is_radial = task.reads_surface &&
                   parameters.geometry.geometry == ContactGeometry::radial;
  return task;
}
} // namespace

BatchLayout pair_layout(const EngineParameters &parameters,
                        const Particles &particles)
{
  BatchLayout layout;
  layout.has_rolling = parameters.stone.rolling_friction > 0.;
  layout.has_sides = particles.has_shapes;
  layout.has_partners = true;
  layout.has_damage =
      particles.has_shapes &&
      may_break(parameters.breakage, parameters.geometry.geometry);
  layout.has_level = layout.has_damage && parameters.breakage.needs_level();
  return layout;
}

ForceSum pair_forces(const ForceContext &context, ContactBatch &batch,
                     PairLoads &loads, std::vector<RangeSum> &ranges)
{
  SurfaceOwner owner{context, batch};
  kernel::Task task = pair_task(owner);
  loads.clear();
  task.stones.halo = reinterpret_cast<double *>(loads.halo_rows());
  const ForceSum sum =
      run_loop(kernel::loops().pairs, task, batch.size(), ranges);
  loads.add_halo(context.particles.load);
  return sum;
}

double reset_pair(const ForceContext &context, ContactBatch &batch,
                  std::size_t k)
{
  return run_still(context, batch, k, kernel::loops().pairs, pair_task);
}
} // namespace dem
