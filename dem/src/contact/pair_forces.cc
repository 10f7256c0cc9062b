#include "surfaces.h"

#include <dem/contact/forces.h>

namespace dem
{
namespace
{
kernel::Task pair_task(SurfaceOwner &owner)
{
  const EngineParameters &parameters = owner.context.parameters;
  const ParticleMaterial &particle = parameters.particle;
  kernel::Task task =
      make_task(owner, {particle.friction, particle.rolling_friction,
                        particle.normal_damping, particle.shear_damping});
  const HertzPrefactors prefactors =
      unit_prefactors(owner.context.elasticity.pair(0, 0));
  task.normal_factor = prefactors.normal;
  task.shear_factor = prefactors.tangential;
  task.is_radial = task.reads_surface &&
                   traits(parameters.geometry.geometry).is_along_branch;
  return task;
}

kernel::Loop pair_loop(const ContactBatch &batch)
{
  const kernel::Loops &loops = batch.layout.law.entry().loops();
  return required(batch.layout.has_contact_points ? loops.surface_pairs
                                                  : loops.pairs,
                  batch.layout.law.entry());
}
} // namespace

BatchLayout pair_layout(const EngineParameters &parameters,
                        const ParticleSystem &particles)
{
  const GeometryTraits geometry = traits(parameters.geometry.geometry);
  BatchLayout layout;
  layout.law = law_of(parameters.particle);
  layout.has_attraction = layout.law.entry().attracts;
  layout.has_rolling = parameters.particle.rolling_friction > 0.;
  layout.has_sides = particles.has_shapes || particles.has_materials;
  layout.has_partners = true;
  layout.has_prefactors = layout.has_sides;
  layout.has_contact_points = layout.has_sides && geometry.has_common_normal;
  layout.has_damage =
      particles.has_shapes && may_break(parameters.breakage, geometry);
  layout.has_reversal =
      layout.has_damage && parameters.breakage.needs_reversal();
  layout.has_peak = layout.has_damage && parameters.breakage.repetitions > 1.;
  return layout;
}

ForceSum pair_forces(const ForceContext &context, ContactBatch &batch,
                     PairLoads &loads, std::vector<RangeSum> &ranges)
{
  SurfaceOwner owner{context, batch};
  kernel::Task task = pair_task(owner);
  task.particles.halo = reinterpret_cast<double *>(loads.halo_rows());
  const ForceSum sum = run_loop(pair_loop(batch), task, owner, ranges);
  loads.add_halo(context.particles.load);
  return sum;
}

double reset_pair(const ForceContext &context, ContactBatch &batch,
                  std::size_t k)
{
  return run_still(context, batch, k, pair_loop(batch), pair_task);
}
} // namespace dem
