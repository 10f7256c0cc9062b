#include "triaxial/kind.h"

#include "triaxial/triaxial.h"

namespace spall
{
namespace
{
void set_defaults(Case &c)
{
  // Long particles with the rolling friction of the material never come to
  // rest with radii along the branch.
  c.specimen.shapes = "shapes/limestone_blocky";
  c.particle.rolling_friction = 0.5;
  // Without it a sheet rings between the particles: docs/results/
  // error_of_boundary.md.
  c.membrane.mass_damping = 200.;
}

void set_template(Case &c)
{
  c.coupling.exchange = ExchangeChoice::every_step;
}

std::string one_rank_setting(const Case &parameters)
{
  return parameters.boundary.lateral == Lateral::periodic
             ? "Boundary/lateral = periodic"
             : "";
}

std::unique_ptr<Test> make(const Case &parameters)
{
  return std::make_unique<Triaxial>(parameters);
}
} // namespace

TestKind triaxial_kind()
{
  return {
      .name = "dynamic_triaxial",
      .sections =
          {{"Specimen", "Particles, form and size of the specimen."},
           {"Preparation",
            "Compaction of the random cloud of particles by servo-controlled "
            "walls."},
           {"Boundary", "Lateral boundary and top plate of the specimen."},
           {"Loading",
            "Confining pressure, consolidation and loading by the top plate."},
           {"CycleJump",
            "Accelerated damage cycles: most load cycles are extrapolated "
            "instead of simulated."}},
      .shared_sections = {"MembraneContact", "Membrane", "Coupling", "Walls"},
      .add_parameters = add_triaxial,
      .set_defaults = set_defaults,
      .set_template = set_template,
      .check = check_triaxial,
      .notices = triaxial_notices,
      .make = make,
      .runs_on_many_ranks = true,
      .needs_one_rank = one_rank_setting,
      .seed_key = "Specimen/seed",
      .gradation_section = "Specimen",
      // The step may change the cycle end: Triaxial::restore() checks it.
      .may_change = {"Time/step", "Time/fixed_step", "Time/safety",
                     "Time/impact_error", "Time/force_tolerance",
                     "Time/energy_tolerance"},
      .report = triaxial_report};
}
} // namespace spall
