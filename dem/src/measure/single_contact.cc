#include <dem/engine_boundaries.h>
#include <dem/measure/assembly.h>
#include <dem/measure/network.h>
#include <dem/measure/single_contact.h>

namespace dem
{
namespace
{
/// The engine of one contact: nothing acts but the contact.
EngineParameters contact_alone(EngineParameters parameters)
{
  parameters.gravity = Vec3::Zero();
  parameters.local_damping = 0.;
  parameters.breakage.is_active = false;
  return parameters;
}

void add_particle(Engine &engine, const PosedParticle &one)
{
  engine.add_particle(one.shape, one.position, one.orientation, one.material);
  ParticleSystem &particles = engine.particles();
  const std::size_t last = particles.size() - 1;
  particles.velocity(last) = one.velocity;
  particles.spin(last) = one.spin;
}

/// Loads and contact points with a boundary, whose normals are normal_of(k).
template <class Normal>
ContactState state_on_wall(const Engine &engine, const ContactBatch &batch,
                           const Normal &normal_of)
{
  ContactState state;
  state.on_a = engine.particles().load[0];
  for (std::size_t k = 0; k < batch.size(); ++k)
  {
    if (!batch.is_touching(k))
      continue;
    const Vec3 &force = batch.load[k].force;
    state.points.push_back({batch.overlap[k], normal_of(k),
                            wall_contact_point(engine, batch, k), force,
                            batch.stored_energy(k)});
  }
  // What A gets, the boundary gives: the same resultant, opposite.
  state.on_b = {-state.on_a.force,
                -(state.on_a.moment +
                  engine.particles().position(0).cross(state.on_a.force))};
  return state;
}
} // namespace

ContactState evaluate_contact(const EngineParameters &parameters,
                              const PosedParticle &a, const PosedParticle &b,
                              double time_step)
{
  Engine engine(contact_alone(parameters));
  add_particle(engine, a);
  add_particle(engine, b);
  engine.evaluate(time_step);
  const ContactBatch &pairs = engine.pairs();
  ContactState state;
  state.on_a = engine.particles().load[0];
  state.on_b = engine.particles().load[1];
  for (std::size_t k = 0; k < pairs.size(); ++k)
  {
    if (!pairs.is_touching(k))
      continue;
    const ContactFrame frame = pair_contact_frame(engine, k);
    // The first side of the contact is the lighter particle.
    const double sign = pairs.a[k] == 0 ? 1. : -1.;
    state.points.push_back({pairs.overlap[k], sign * frame.normal, frame.point,
                            sign * pair_force(engine.particles(), pairs, k),
                            pairs.stored_energy(k)});
  }
  return state;
}

ContactState evaluate_contact(const EngineParameters &parameters,
                              const PosedParticle &a, const Plane &plane,
                              double time_step)
{
  Engine engine(contact_alone(parameters));
  add_particle(engine, a);
  add_plane(engine, plane.point, plane.normal);
  planes(engine)[0].velocity = plane.velocity;
  engine.evaluate(time_step);
  const Vec3 normal = -planes(engine)[0].normal;
  return state_on_wall(engine, on_planes(engine),
                       [&normal](std::size_t) { return normal; });
}

ContactState evaluate_contact(const EngineParameters &parameters,
                              const PosedParticle &a, FacetSurface &surface,
                              double time_step)
{
  Engine engine(contact_alone(parameters));
  add_particle(engine, a);
  attach_surface(engine, surface);
  engine.evaluate(time_step);
  surface.load = dem::surface(engine).load;
  return state_on_wall(
      engine, on_facets(engine),
      [&engine](std::size_t k)
      { return facet_boundary(engine).contact_points.point[k].normal; });
}
} // namespace dem
