#include "case/checks.h"

#include "case/list.h"
#include "case/notices.h"
#include "case/parameter.h"
#include "triaxial/kind.h"
#include "triaxial/load_path.h"

#include <algorithm>
#include <limits>

namespace spall
{
namespace
{
void check_specimen(const Case &c, const SourceLocation &location)
{
  const SpecimenParameters &s = c.specimen;
  check_shapes(c, location, "Specimen", s.shapes);
  if (!s.particles.empty())
    return; // their number and sizes are those of the file
  if (s.initial_solid_fraction >= s.solid_fraction)
    refuse(location, {"Specimen", "initial_solid_fraction",
                      number_text(s.initial_solid_fraction),
                      "must be below Specimen/solid_fraction = " +
                          number_text(s.solid_fraction)});
  const Gradation curve = check_gradation(c, location, "Specimen", s.gradation);
  const double largest = curve.diameter.back();
  const auto check_size = [&](const std::string &key, double size)
  {
    if (size < 2. * largest)
      refuse(location, {"Specimen", key, number_text(size),
                        "must be at least twice the largest particle of the "
                        "gradation, " +
                            largest_text(curve)});
  };
  if (s.form == SpecimenForm::box)
    check_size("side", s.side);
  else
  {
    check_size("diameter", s.diameter);
    check_size("height", s.height);
  }
}

/// Opposite sides of a cylinder do not fit on each other.
void check_periodic(const Case &c, const SourceLocation &location)
{
  if (c.boundary.lateral == Lateral::periodic &&
      c.specimen.form != SpecimenForm::box)
    refuse(location,
           {"Boundary", "lateral", "periodic", "needs Specimen/form = box"});
}

void check_cycle_jump(const Case &c, const SourceLocation &location)
{
  if (c.cycle_jump.is_on() && c.loading.form != LoadForm::haversine)
    refuse(location,
           {"CycleJump", "tolerance", number_text(c.cycle_jump.tolerance),
            "must be 0 unless Loading/form = haversine, which has equal "
            "cycles"});
}

/// Particles are moved along their mean motion past walls that are at rest.
void check_walls(const Case &c, const SourceLocation &location)
{
  if (c.cycle_jump.is_on())
    for (const WallSection &wall : c.walls)
      check_at_rest(c, location, wall,
                    "must not be set with CycleJump/tolerance above 0: jumps "
                    "need walls at rest");
}

LoadPath check_path(const Case &c, const SourceLocation &location)
{
  if (c.loading.form == LoadForm::path && c.loading.path.empty())
    refuse(location, {"Loading", "path", "(empty)",
                      "must be a CSV file with Loading/form = path"});
  return load_path_of(c);
}

void check_time(const Case &c, const SourceLocation &location)
{
  const std::vector<double> periods =
      expected_periods(check_path(c, location), c.loading.confining_pressure);
  // A stage that begins at its target has no length.
  double shortest = std::numeric_limits<double>::infinity();
  for (const double period : periods)
    if (period > 0.)
      shortest = std::min(shortest, period);
  const double sample = shortest / c.output.samples_per_cycle;
  const int n = c.coupling.exchange_rules(c.boundary.lateral).particle_steps;
  if (c.time.step == StepRule::fixed && n * c.time.fixed_step > sample)
    refuse(location, {"Time", "fixed_step", number_text(c.time.fixed_step),
                      "a window of " + std::to_string(n) +
                          " must be at most one sample of history.csv, " +
                          number_text(sample) +
                          " s (the shortest period of Loading over "
                          "Output/samples_per_cycle)"});
  if (c.output.frames_per_cycle > c.output.samples_per_cycle)
    refuse(location, {"Output", "frames_per_cycle",
                      std::to_string(c.output.frames_per_cycle),
                      "must be at most Output/samples_per_cycle = " +
                          std::to_string(c.output.samples_per_cycle)});
}
} // namespace

void check_triaxial(const Case &c, const SourceLocation &location)
{
  check_inertia(c, location);
  check_specimen(c, location);
  if (c.boundary.lateral == Lateral::membrane)
  {
    check_contact_tangent(c, location, true);
    check_membrane(c, location, "Boundary/lateral = membrane");
  }
  check_periodic(c, location);
  check_cycle_jump(c, location);
  check_walls(c, location);
  check_time(c, location);
}

std::vector<std::string> triaxial_notices(const Case &c,
                                          const SetLocations &set)
{
  const auto location = set.find("Loading/path");
  if (location == set.end() || c.loading.form != LoadForm::path)
    return {};
  std::vector<std::string> notices;
  int number = 0;
  for (const LoadStage &stage : load_path_of(c).stages)
  {
    ++number;
    const auto note = [&](const std::string &what, double stress)
    {
      if (is_unusual(stress, usual_stresses))
        notices.push_back(location->second + ": Loading/path: " + what +
                          " of stage " + std::to_string(number) + " = " +
                          number_text(stress) + ": " +
                          unusual_text(usual_stresses, "Pa"));
    };
    const auto note_target =
        [&](const std::string &what, const LoadDirection &direction)
    {
      if (direction.control == LoadControl::stress)
        note(what, direction.target.value_or(0.));
    };
    note_target("axial stress", stage.axial);
    note_target("stress along x", stage.sides[0]);
    note_target("stress along y", stage.sides[1]);
    note("amplitude", stage.amplitude);
    note("lateral amplitude", stage.side_amplitude);
  }
  return notices;
}
} // namespace spall
