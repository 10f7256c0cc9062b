#include <dem/boundary/drum_contacts.h>

namespace dem
{
void find_drum(const ParticleSystem &particles, const Drum &drum,
               const ContactBatch &batch, std::vector<WallRow> &rows)
{
  rows.resize(particles.size() * static_cast<std::size_t>(n_drum_parts));
  for (std::size_t k = 0; k < batch.size(); ++k)
  {
    const auto i = static_cast<std::size_t>(batch.a[k]);
    const DrumPart part = drum_part(batch, k);
    const DrumPoint at = nearest_on_drum(drum, part, particles.position(i));
    WallRow &row = rows[static_cast<std::size_t>(batch.b[k])];
    WallRow now{at.point,     at.normal, drum.velocity_at(part, at.point),
                Vec3::Zero(), at.normal, 0.};
    now.velocity_before = now.velocity;
    if (batch.is_touching(k))
    {
      now.velocity_before = row.velocity;
      now.normal_before = row.normal;
    }
    row = now;
  }
}

double drum_torque(const Drum &drum, const ContactBatch &batch,
                   const std::vector<WallRow> &rows)
{
  double torque = 0.;
  for (std::size_t k = 0; k < batch.size(); ++k)
  {
    const Vec3 &point = rows[static_cast<std::size_t>(batch.b[k])].point;
    torque -= (point - drum.centre).cross(batch.load[k].force).dot(drum.axis);
  }
  return torque;
}

double drum_thrust(const ContactBatch &batch, const std::vector<WallRow> &rows)
{
  double thrust = 0.;
  for (std::size_t k = 0; k < batch.size(); ++k)
    if (drum_part(batch, k) == DrumPart::cylinder)
      thrust -= batch.load[k].force.dot(
          rows[static_cast<std::size_t>(batch.b[k])].normal);
  return thrust;
}
} // namespace dem
