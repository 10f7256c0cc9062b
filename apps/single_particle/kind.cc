#include "single_particle/kind.h"

#include "single_particle/single_particle.h"

namespace spall
{
namespace
{
void set_defaults(Case &c)
{
  c.title = "single particle between platens";
  c.wall.law = "hertz";
  c.contact.wall_geometry = dem::ContactGeometry::radial;
}

std::unique_ptr<Test> make(const Case &parameters)
{
  return std::make_unique<SingleParticle>(parameters);
}
} // namespace

TestKind single_particle_kind()
{
  return {.name = "single_particle",
          .sections =
              {{"Press",
                "Two rigid platens, of which the upper one moves downward."}},
          .shared_sections = {"Walls"},
          .add_parameters = add_single_particle,
          .set_defaults = set_defaults,
          .check = check_single_particle,
          .make = make,
          .seed_key = "Particle/seed",
          .report = single_particle_report};
}
} // namespace spall
