#include "case/notices.h"

#include <algorithm>

namespace spall
{
std::string unusual_text(const Range &usual, const std::string &unit)
{
  return "unusual: most are " + bounds_text(usual) + " " + unit +
         ", so check the unit";
}

namespace
{
/// Equivalent spheres touch nowhere that their particles are seen to touch.
bool breaks_nothing(const Case &c)
{
  return c.breakage.is_active &&
         c.breakage.contacts == dem::EventContacts::seen &&
         c.contact.geometry == dem::ContactGeometry::sphere &&
         c.contact.wall_geometry == dem::ContactGeometry::sphere;
}
} // namespace

std::vector<std::string> notices_on(const Case &c,
                                    const std::vector<Parameter> &list,
                                    const SetLocations &set)
{
  std::vector<std::string> notices;
  const bool is_idle = breaks_nothing(c);
  for (const Parameter &parameter : list)
  {
    const auto location = set.find(parameter.name());
    if (location == set.end())
      continue;
    const auto note = [&](const std::string &what)
    {
      notices.push_back(location->second + ": " + parameter.name() + " = " +
                        value_text(parameter) + ": " + what);
    };
    if (is_unusual(parameter))
      note(unusual_text(parameter.usual, parameter.unit));
    if (is_idle && parameter.name() == "Breakage/is_active")
      note("nothing breaks: Contact/geometry = sphere needs "
           "Breakage/contacts = all");
  }
  if (const auto of_kind = find_kind(c.kind)->notices)
    for (const std::string &notice : of_kind(c, set))
      notices.push_back(notice);
  return notices;
}
} // namespace spall
