#include "compaction/kind.h"

#include "compaction/compaction.h"

namespace spall
{
namespace
{
void set_defaults(Case &c)
{
  c.title = "vibratory compaction test";
  // As in the Los Angeles drum: particles that are poured spin.
  c.wall.law = "hertz";
  c.contact.geometry = c.contact.wall_geometry = dem::ContactGeometry::sphere;
  c.breakage.contacts = dem::EventContacts::all;
  c.time.step = StepRule::stable;
  // A sleeve that stands 330 kPa from above, not latex.
  c.membrane.youngs_modulus = 1e8;
  c.membrane.thickness = 3e-3;
}

std::unique_ptr<Test> make(const Case &parameters)
{
  return std::make_unique<Compaction>(parameters);
}
} // namespace

TestKind compaction_kind()
{
  return {
      .name = "vibratory_compaction",
      .sections = {{"Filling",
                    "Particles of the layer and their filling to the requested "
                    "density."},
                   {"Plate",
                    "Plate on the particles: rigid, tilting or elastic."},
                   {"Vibration", "Exciter on the plate, duration and output."}},
      .shared_sections = {"Container", "MembraneContact", "Membrane",
                          "Coupling", "Walls"},
      .add_parameters = add_compaction,
      .set_defaults = set_defaults,
      .check = check_compaction,
      .notices = compaction_notices,
      .make = make,
      .runs_on_many_ranks = true,
      .seed_key = "Filling/seed",
      .gradation_section = "Filling",
      .report = compaction_report};
}
} // namespace spall
