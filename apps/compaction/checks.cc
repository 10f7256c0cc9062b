#include "case/checks.h"

#include "case/file.h"
#include "case/parameter.h"
#include "compaction/kind.h"

#include <sstream>
#include <stdexcept>

namespace spall
{
std::vector<double> report_times(const std::string &text)
{
  std::istringstream words(text);
  std::vector<double> times;
  for (std::string word; words >> word;)
  {
    times.push_back(to_number(word));
    if (times.back() <= 0. ||
        (times.size() > 1 && times.back() <= *(times.end() - 2)))
      throw std::invalid_argument("not ascending from above 0");
  }
  return times;
}

namespace
{
void check_reports(const Case &c, const Place &place)
{
  try
  {
    report_times(c.vibration.reports);
  }
  catch (const std::invalid_argument &)
  {
    refuse(place, {"Vibration", "reports", c.vibration.reports,
                   "must be ascending numbers above 0 with blanks between"});
  }
}

void check_size(const Case &c, const Place &place)
{
  const Gradation curve =
      check_gradation(c, place, "Filling", c.filling.gradation);
  const double largest = curve.diameter.back();
  const std::string why =
      "must be at least twice the largest particle of the gradation, " +
      largest_text(curve);
  const ContainerParameters &box = c.container;
  if (box.diameter < 2. * largest)
    refuse(place, {"Container", "diameter", number_text(box.diameter), why});
  if (box.height < 2. * largest)
    refuse(place, {"Container", "height", number_text(box.height), why});
}

void check_plate(const Case &c, const Place &place)
{
  if (c.plate.form != PlateKind::elastic)
    return;
  if (c.coupling.exchange == ExchangeChoice::none)
    refuse(place, {"Coupling", "exchange", "none",
                   "with Plate/form = elastic must be one of every_step, "
                   "one_pass, iterated"});
  check_equal_windows(c, place);
  check_every_step(c, place);
  if (c.plate.load_radius > 0.5 * c.container.diameter)
    refuse(place, {"Plate", "load_radius", number_text(c.plate.load_radius),
                   "must be at most half of Container/diameter = " +
                       number_text(c.container.diameter)});
}
} // namespace

void check_compaction(const Case &c, const Place &place)
{
  check_inertia(c, place);
  check_contact_tangent(c, place, c.container.is_flexible());
  check_size(c, place);
  check_plate(c, place);
  check_shapes(c, place, "Filling", c.filling.shapes);
  check_reports(c, place);
  if (c.plate.form == PlateKind::elastic &&
      dem::law_of(c.wall).entry().attracts)
    refuse(place, {"Wall", "law", c.wall.law,
                   "must not attract with Plate/form = elastic: facets have no "
                   "attraction across gaps"});
  if (c.filling.density > 0.75 * c.particle.density)
    refuse(place, {"Filling", "density", number_text(c.filling.density),
                   "must be at most 0.75 Particle/density = " +
                       number_text(0.75 * c.particle.density) +
                       ": random packings stay below"});
  const double longest = 0.05 / c.vibration.frequency;
  const Lateral soft =
      c.plate.form == PlateKind::elastic || c.container.is_flexible()
          ? Lateral::membrane
          : Lateral::rigid;
  const int n = c.coupling.exchange_rules(soft).particle_steps;
  if (c.time.step == StepRule::fixed && n * c.time.fixed_step > longest)
    refuse(place, {"Time", "fixed_step", number_text(c.time.fixed_step),
                   "a window of " + std::to_string(n) +
                       " must be at most a twentieth of the period of "
                       "Vibration/frequency, " +
                       number_text(longest) + " s"});
  if (c.container.is_flexible())
    check_membrane(c, place, "Container/form = flexible");
  check_no_step_error(c, place);
}
} // namespace spall
