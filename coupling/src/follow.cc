#include <coupling/exchange.h>

namespace coupling
{
void Exchange::follow(const Body &body, FieldView velocity,
                      const Stones &stones, double time_step)
{
  Joint &joint = joints[joint_of(body)];
  const FieldView position = body.motion().position;
  joint.at = joint.target = Field(position.begin(), position.end());
  if (parameters.has_contact_tangent)
    joint.from = joint.at;
  joint.seam->place({joint.at, velocity}, stones.engine);
  stones.advance(time_step);
  joint.seam->collect(stones.engine, Collected::load, joint.load);
}
} // namespace coupling
