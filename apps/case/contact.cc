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
       "Contact geometry of two particles. The value sphere takes the overlap "
       "of the equivalent spheres. The value radial takes the local radii "
       "along the branch vector. The value surface takes the true surfaces at "
       "every contact point, with the inertia tensors of the particles."},
      c.geometry, {"sphere", "radial", "surface"}, {{"ball", "sphere"}});
  list.add({"wall_geometry", "-",
            "Contact geometry of particles with platens, rigid sides, membrane "
            "and drum, with the same values. Where particles also meet each "
            "other, surface requires geometry = surface."},
           c.wall_geometry, {"sphere", "radial", "surface"},
           {{"ball", "sphere"}});
  add_law(list,
          {"law", "-",
           "Contact law between particles. The value hertz is the elliptic "
           "Hertz contact with the curvatures of the particles. The value "
           "linear uses springs of constant stiffness. The value dmt adds the "
           "attraction of moist fine particles to hertz."},
          of.particle.law);
  add_law_values(list, of.pair_laws);
  list.add({"refresh_tolerance", "rad",
            "Rotation of the contact direction in the body frame after which "
            "the series of the shape is evaluated again. With true surfaces it "
            "is the distance of the contact point from the vertex of the "
            "osculating paraboloid, over the height of the vertex. The value 0 "
            "evaluates the series in every step."},
           c.refresh_tolerance, between(0., 0.1));
  list.add({"skin",
            "m",
            "Distance beyond contact up to which pairs enter the lists of "
            "candidates. The value 0 chooses the cheapest distance at each "
            "rebuild from the motion since the last one.",
            "",
            {"search_margin"}},
           c.skin, between(0., 1.));
  list.in("Contact", {.decides_preparation = false, .may_change = true});
  list.add({"overlap_warning", "-",
            "Overlap over the radius of the smaller equivalent sphere above "
            "which the run gives a warning. Hertz theory does not hold for "
            "larger overlaps."},
           c.overlap.warning, above(0., 1.));
  list.add({"overlap_stop", "-",
            "Overlap over radius above which the run fails. At the value 1 a "
            "wall reaches the centre of a particle."},
           c.overlap.stop, above(0., 1.));
  list.in("Contact");
  list.add({"friction_limit", "-",
            "Normal force in the limits of sliding and rolling friction. The "
            "value elastic is the force of the spring alone. The value total "
            "includes the dashpot."},
           of.friction_limit, {"elastic", "total"});
}
} // namespace spall
