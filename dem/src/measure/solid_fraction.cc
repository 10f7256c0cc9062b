#include <dem/measure/boundary_profile.h>
#include <dem/measure/solid_fraction.h>

namespace dem
{
double solid_fraction(const Prism &space, const ParticleSystem &particles)
{
  constexpr int n_sections = 100;
  const ProfileWidths widths{0.1 * (space.high - space.low), 0.};
  return 1. -
         boundary_profile(particles, {}, outline_of(space, n_sections), widths)
             .porosity;
}
} // namespace dem
