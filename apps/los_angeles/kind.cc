#include "los_angeles/kind.h"

#include "los_angeles/los_angeles.h"

namespace spall
{
namespace
{
void set_defaults(Case &c)
{
  c.title = "Los Angeles abrasion test";
  c.wall.law = "hertz";
  // Radii along the branch feed particles that spin with energy; balls break
  // particles although their overlaps do not see it.
  c.contact.geometry = c.contact.wall_geometry = dem::ContactGeometry::sphere;
  c.breakage.contacts = dem::EventContacts::all;
  c.time.step = StepRule::stable;
  c.time.local_damping = 0.; // particles fly
}

std::unique_ptr<Test> make(const Case &parameters)
{
  return std::make_unique<LosAngeles>(parameters);
}
} // namespace

TestKind los_angeles_kind()
{
  return {.name = "los_angeles",
          .sections =
              {{"Charge", "Particles and steel balls in the drum."},
               {"Drum",
                "Geometry and rotation of the Los Angeles drum, and output."}},
          .shared_sections = {"Walls"},
          .add_parameters = add_los_angeles,
          .set_defaults = set_defaults,
          .check = check_los_angeles,
          .make = make,
          .runs_on_many_ranks = true,
          .seed_key = "Charge/seed",
          .gradation_section = "Charge",
          .report = los_angeles_report};
}
} // namespace spall
