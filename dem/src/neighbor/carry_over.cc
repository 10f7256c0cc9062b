#include "carry_over.h"

#include "../contact/surfaces.h"

namespace dem
{
void retire_contact(const ContactBatch &batch, std::size_t k,
                    LostEnergy &retired)
{
  if (!batch.has_force(k))
    return;
  const ContactHistory<double> history = batch.history(k);
  const double rolling =
      0.5 * dot(history.rolling, history.rolling) * history.rolling_compliance;
  retired.rolling.add(rolling);
  retired.friction.add(tangential_energy(history) - rolling);
  retired.non_conservative_work.add(history.normal_energy);
}

void note_corners(const ParticleSystem &particles, ContactBatch &batch)
{
  for (std::size_t k = 0; k < batch.size(); ++k)
  {
    if (batch.side_a.is_known(k))
      note_corner(particles, batch, k, true);
    if (batch.layout.has_partners && batch.side_b.is_known(k))
      note_corner(particles, batch, k, false);
    if (batch.layout.has_reversal)
      batch.reversal[k] = static_cast<Narrow>(batch.stored_energy(k));
  }
}
} // namespace dem
