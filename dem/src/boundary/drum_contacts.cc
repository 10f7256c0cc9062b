#include <dem/boundary/drum_contacts.h>

#include <utility>

namespace dem
{
void name_by_part(ContactBatch &batch)
{
  for (std::size_t k = 0; k < batch.size(); ++k)
    batch.b[k] %= n_drum_parts;
}

void number_drum_contacts(const std::vector<std::int32_t> &source,
                          ContactBatch &batch, std::vector<WallRow> &rows)
{
  std::vector<WallRow> fresh(batch.size() *
                             static_cast<std::size_t>(n_drum_parts));
  for (std::size_t k = 0; k < batch.size(); ++k)
  {
    const std::int32_t part = batch.b[k];
    batch.b[k] = n_drum_parts * static_cast<std::int32_t>(k) + part;
    if (source[k] >= 0)
      fresh[static_cast<std::size_t>(batch.b[k])] =
          rows[static_cast<std::size_t>(n_drum_parts * source[k] + part)];
  }
  rows = std::move(fresh);
}

void find_drum(const ParticleSystem &particles, const Drum &drum,
               const ContactBatch &batch, std::vector<WallRow> &rows)
{
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

double torque_on_drum(const Drum &drum, const ContactBatch &batch,
                      std::size_t k, const WallRow &row)
{
  return -(row.point - drum.centre).cross(batch.load[k].force).dot(drum.axis);
}

double thrust_on_drum(const ContactBatch &batch, std::size_t k,
                      const WallRow &row)
{
  return drum_part(batch, k) == DrumPart::cylinder
             ? -batch.load[k].force.dot(row.normal)
             : 0.;
}
} // namespace dem
