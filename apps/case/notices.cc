#include "case/notices.h"

#include <algorithm>

namespace spall
{
namespace
{
std::string unusual_text(const Parameter &parameter)
{
  return "unusual: most are " + usual(parameter) + " " + parameter.unit +
         ", so check the unit";
}

/// Equivalent spheres touch nowhere that their particles are seen to touch.
bool breaks_nothing(const Case &c)
{
  return c.breakage.is_active &&
         c.breakage.contacts == dem::EventContacts::seen &&
         c.contact.geometry == dem::ContactGeometry::sphere &&
         c.contact.wall_geometry == dem::ContactGeometry::sphere;
}
} // namespace

std::vector<std::string>
notices_on(const Case &c, const std::vector<Parameter> &list,
           const std::map<std::string, std::string> &locations)
{
  std::vector<std::string> notices;
  const bool is_idle = breaks_nothing(c);
  for (const Parameter &parameter : list)
  {
    const auto location = locations.find(parameter.name());
    if (location == locations.end())
      continue;
    const auto note = [&](const std::string &what)
    {
      notices.push_back(location->second + ": " + parameter.name() + " = " +
                        value_text(parameter) + ": " + what);
    };
    if (is_unusual(parameter))
      note(unusual_text(parameter));
    if (is_idle && parameter.name() == "Breakage/is_active")
      note("nothing breaks: Contact/geometry = sphere needs "
           "Breakage/contacts = all");
  }
  return notices;
}
} // namespace spall
