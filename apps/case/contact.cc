#include "case/list.h"

namespace spall
{
void add_law(List &list, const Text &text, std::string &name)
{
  std::vector<std::string> names;
  for (const dem::ContactLaw &law : dem::contact_laws())
    names.push_back(law.name);
  list.add_name(text, name, names);
}

void add_law_values(List &list, std::vector<dem::LawValues> &values)
{
  for (std::size_t n = 0; n < values.size(); ++n)
  {
    const auto &parameters = dem::contact_laws()[n].parameters;
    for (std::size_t i = 0; i < parameters.size(); ++i)
      if (const dem::LawParameter &p = parameters[i]; !list.has(p.key))
        list.add(
            {std::string(p.key), std::string(p.unit), std::string(p.sentence)},
            values[n][i], between(p.lowest, p.highest));
  }
}

void add_contact(List &list, Case &of)
{
  dem::GeometryParameters &c = of.contact;
  list.in("Contact");
  list.add(
      {"geometry", "-",
       "sphere: overlap of the equivalent spheres; radial: of the local radii "
       "along the branch; surface: of the true surfaces, at every contact "
       "point, with the inertia tensors of the particles."},
      c.geometry, {"sphere", "radial", "surface"}, {{"ball", "sphere"}});
  list.add({"wall_geometry", "-",
            "The same for particles on platens, rigid sides, the membrane and "
            "the drum; surface needs geometry = surface where particles meet."},
           c.wall_geometry, {"sphere", "radial", "surface"},
           {{"ball", "sphere"}});
  add_law(list,
          {"law", "-",
           "Law of particles on each other: hertz, elliptic Hertz contact with "
           "the curvatures of the particles; linear, springs of constant "
           "stiffness; dmt, Hertz with the attraction of moist fines."},
          of.particle.law);
  add_law_values(list, of.pair_laws);
  list.add(
      {"refresh_tolerance", "rad",
       "The expansion of a shape is renewed when the contact direction has "
       "moved this far in the body; 0: every step."},
      c.refresh_tolerance, between(0., 0.1));
  list.add({"skin",
            "m",
            "How far beyond contact the lists of candidates look; 0: set at "
            "each rebuild to what costs least at the motion since the last.",
            "",
            {"search_margin"}},
           c.skin, between(0., 1.));
  list.in("Contact", {.decides_preparation = false, .may_change = true});
  list.add({"overlap_warning", "-",
            "Overlap over the radius of the smaller equivalent sphere: a "
            "warning above it, since Hertz theory no longer holds."},
           c.overlap.warning, above(0., 1.));
  list.add({"overlap_stop", "-",
            "The run fails above this overlap over radius. At 1 a wall reaches "
            "the centre of a particle."},
           c.overlap.stop, above(0., 1.));
  list.in("Contact");
  list.add({"friction_limit", "-",
            "Normal force in the limits of friction and rolling: elastic, of "
            "the spring alone; total, with its dashpot."},
           of.friction_limit, {"elastic", "total"});
}
} // namespace spall
