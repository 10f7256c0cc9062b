#include "case_checks.h"

#include "case_file.h"
#include "errors.h"
#include "gradation.h"
#include "parameter.h"

#include <filesystem>

namespace spall
{
namespace
{
/// One refusal: section, key and value as given, and what is allowed.
struct Fault
{
  std::string section, key, value, allowed;
};

[[noreturn]] void refuse(const Place &place, const Fault &fault)
{
  throw InputError(place(fault.section, fault.key) + ": " + fault.section +
                   "/" + fault.key + " = " + fault.value + ": " +
                   fault.allowed);
}

void check_specimen(const Case &c, const Place &place)
{
  const SpecimenParameters &s = c.specimen;
  if (s.initial_solid_fraction >= s.solid_fraction)
    refuse(place, {"Specimen", "initial_solid_fraction",
                   number_text(s.initial_solid_fraction),
                   "must be below Specimen/solid_fraction = " +
                       number_text(s.solid_fraction)});
  if (s.gradation.empty())
    refuse(place, {"Specimen", "gradation", "",
                   "must name a CSV file diameter_m,passing_1"});
  const Gradation curve =
      read_gradation(find_path(c, "Specimen", "gradation", s.gradation));
  if (const double largest = curve.diameter.back(); s.side < 2. * largest)
    refuse(place, {"Specimen", "side", number_text(s.side),
                   "must be at least twice the largest stone of the "
                   "gradation, " +
                       number_text(largest) + " m"});
  if (!s.shapes.empty())
  {
    const std::string folder = find_path(c, "Specimen", "shapes", s.shapes);
    if (!std::filesystem::is_directory(folder))
      refuse(place, {"Specimen", "shapes", s.shapes,
                     "must be a folder of shape files, or empty for spheres"});
  }
}

void check_breakage(const Case &c, const Place &place)
{
  const dem::BreakageParameters &b = c.breakage;
  if (2. * b.min_ball_radius > b.min_diameter)
    refuse(place,
           {"Breakage", "min_ball_radius", number_text(b.min_ball_radius),
            "must be at most half of Breakage/min_diameter = " +
                number_text(b.min_diameter)});
}

void check_time(const Case &c, const Place &place)
{
  const double sample = 1. / (c.loading.frequency * c.output.samples_per_cycle);
  if (c.time.step == StepRule::fixed && c.time.fixed_step > sample)
    refuse(place, {"Time", "fixed_step", number_text(c.time.fixed_step),
                   "must be at most one sample of history.csv, " +
                       number_text(sample) +
                       " s (1 / (Loading/frequency "
                       "Output/samples_per_cycle))"});
  if (c.output.frames_per_cycle > c.output.samples_per_cycle)
    refuse(place, {"Output", "frames_per_cycle",
                   std::to_string(c.output.frames_per_cycle),
                   "must be at most Output/samples_per_cycle = " +
                       std::to_string(c.output.samples_per_cycle)});
}
} // namespace

void check_case(const Case &parameters, const Place &place)
{
  check_specimen(parameters, place);
  check_breakage(parameters, place);
  check_time(parameters, place);
}
} // namespace spall
