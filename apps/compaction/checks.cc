#include "case/checks.h"

#include "case/file.h"
#include "case/parameter.h"
#include "compaction/kind.h"
#include "compaction/scene.h"

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
void check_reports(const Case &c, const SourceLocation &location)
{
  try
  {
    report_times(c.vibration.reports);
  }
  catch (const std::invalid_argument &)
  {
    refuse(location, {"Vibration", "reports", c.vibration.reports,
                      "must be ascending numbers above 0 with blanks between"});
  }
}

void check_size(const Case &c, const SourceLocation &location)
{
  if (!c.filling.particles.empty())
    return; // their sizes are those of the file
  const Gradation curve =
      check_gradation(c, location, "Filling", c.filling.gradation);
  const double largest = curve.diameter.back();
  const std::string why =
      "must be at least twice the largest particle of the gradation, " +
      largest_text(curve);
  const ContainerParameters &box = c.container;
  if (!box.has_mesh() && box.diameter < 2. * largest)
    refuse(location, {"Container", "diameter", number_text(box.diameter), why});
  if (box.height < 2. * largest)
    refuse(location, {"Container", "height", number_text(box.height), why});
}

void check_container_mesh(const Case &c, const SourceLocation &location)
{
  const ContainerParameters &box = c.container;
  if (!box.has_mesh())
    return;
  if (box.is_flexible())
    refuse(location, {"Container", "form", "flexible",
                      "must be rigid with Container/mesh"});
  if (c.plate.form != PlateKind::rigid)
    refuse(location,
           {"Plate", "form",
            c.plate.form == PlateKind::tilting ? "tilting" : "elastic",
            "must be rigid with Container/mesh: other plates are discs as "
            "wide as the cylinder"});
  const dem::Room room = room_in_mesh(c);
  check_container(c, location, *room.container,
                  {"Container", "height", box.height});
  if (c.filling.particles.empty()) // else their sizes are those of the file
    check_container_width(
        c, location, *room.container,
        check_gradation(c, location, "Filling", c.filling.gradation),
        {2., "twice"});
}

void check_plate(const Case &c, const SourceLocation &location)
{
  if (c.plate.form != PlateKind::elastic)
    return;
  if (c.coupling.exchange == ExchangeChoice::none)
    refuse(location, {"Coupling", "exchange", "none",
                      "with Plate/form = elastic must be one of every_step, "
                      "one_pass, iterated"});
  check_equal_windows(c, location);
  check_every_step(c, location);
  if (c.plate.load_radius > 0.5 * c.container.diameter)
    refuse(location, {"Plate", "load_radius", number_text(c.plate.load_radius),
                      "must be at most half of Container/diameter = " +
                          number_text(c.container.diameter)});
}
} // namespace

void check_compaction(const Case &c, const SourceLocation &location)
{
  check_inertia(c, location);
  check_contact_tangent(c, location, c.container.is_flexible());
  check_size(c, location);
  check_container_mesh(c, location);
  check_plate(c, location);
  check_shapes(c, location, "Filling", c.filling.shapes);
  check_reports(c, location);
  if (c.plate.form == PlateKind::elastic &&
      dem::law_of(c.wall).entry().attracts)
    refuse(location,
           {"Wall", "law", c.wall.law,
            "must not attract with Plate/form = elastic: facets have no "
            "attraction across gaps"});
  if (c.filling.density > 0.75 * c.particle.density)
    refuse(location, {"Filling", "density", number_text(c.filling.density),
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
    refuse(location, {"Time", "fixed_step", number_text(c.time.fixed_step),
                      "a window of " + std::to_string(n) +
                          " must be at most a twentieth of the period of "
                          "Vibration/frequency, " +
                          number_text(longest) + " s"});
  if (c.container.is_flexible())
    check_membrane(c, location, "Container/form = flexible");
  check_no_step_error(c, location);
}

std::vector<std::string> compaction_notices(const Case &c,
                                            const SetLocations &set)
{
  const auto location = set.find("Vibration/reports");
  const std::vector<double> times = report_times(c.vibration.reports);
  if (location == set.end() || times.empty() ||
      times.back() <= c.vibration.duration)
    return {};
  return {location->second + ": Vibration/reports = " + c.vibration.reports +
          ": there is none after Vibration/duration = " +
          number_text(c.vibration.duration) + " s"};
}
} // namespace spall
