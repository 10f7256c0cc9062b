#include <coupling/exchange.h>

namespace coupling
{
void Exchange::follow(const DeformableBody &body, FieldView velocity,
                      const CoupledParticles &particles, double time_step)
{
  CoupledBody &coupled = coupled_bodies[coupled_body_of(body)];
  const FieldView position = body.motion().position;
  coupled.at = coupled.target = Field(position.begin(), position.end());
  if (parameters.has_contact_tangent)
    coupled.from = coupled.at;
  coupled.adapter->place({coupled.at, velocity}, particles.engine);
  particles.advance(time_step);
  particles.engine.synchronize();
  coupled.adapter->collect(particles.engine, Collected::load, coupled.load);
}
} // namespace coupling
