#include "subgrade/kind.h"

#include "subgrade/subgrade.h"

namespace spall
{
namespace
{
void set_defaults(Case &c)
{
  c.title = "plate on particles on a subgrade";
  c.coupling.rules.particle_steps = 10;
  c.time.fixed_step = 2e-6;
  c.time.local_damping = 0.; // waves run
  // Particles fall and roll, as in the drum of the Los Angeles test.
  c.contact.geometry = c.contact.wall_geometry = dem::ContactGeometry::sphere;
  c.breakage.contacts = dem::EventContacts::all;
}

void set_template(Case &c)
{
  c.coupling.exchange = ExchangeChoice::one_pass;
}

std::unique_ptr<Test> make(const Case &parameters)
{
  return std::make_unique<Subgrade>(parameters);
}
} // namespace

TestKind subgrade_kind()
{
  return {
      .name = "subgrade",
      .sections =
          {{"Layer",
            "Particle layer on the subgrade, in a box with rigid sides or in "
            "Container/mesh."},
           {"LoadPlate", "Rigid plate or sleeper that loads the particles."},
           {"Subgrade",
            "Subgrade with its top at z = 0: elastic, or with layers that "
            "yield."},
           {"Pulse", "Load on the plate or sleeper."},
           {"Record", "Output files and their intervals."},
           {"GroundContact",
            "Contact of the particles with the subgrade by linear springs."}},
      .shared_sections = {"Container", "Coupling", "Walls"},
      .add_parameters = add_subgrade,
      .set_defaults = set_defaults,
      .set_template = set_template,
      .check = check_subgrade,
      .notices = subgrade_notices,
      .make = make,
      .runs_on_many_ranks = true,
      .seed_key = "Layer/seed",
      .gradation_section = "Layer",
      .report = subgrade_report};
}
} // namespace spall
