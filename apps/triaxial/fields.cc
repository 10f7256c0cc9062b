#include "case/list.h"

#include <dem/shape/spherical_harmonics.h>

namespace spall
{
void add_specimen(List &list, SpecimenParameters &s)
{
  list.in("Specimen");
  list.add({"form", "-", "box: a cube; cylinder: upright, diameter by height."},
           s.form, {"box", "cylinder"});
  list.add({"side", "m", "Edge of the cube after compaction, about."}, s.side,
           between(1e-3, 100.));
  list.add({"diameter", "m",
            "Approximate diameter of the cylinder after compaction."},
           s.diameter, between(1e-3, 100.));
  list.add(
      {"height", "m", "Approximate height of the cylinder after compaction."},
      s.height, between(1e-3, 100.));
  list.add({"solid_fraction", "-",
            "Volume of the particles over that of the cube or cylinder.",
            "random packings stay below 0.75"},
           s.solid_fraction, Range{0., 0.75, true, true});
  list.add_path(
      {"gradation", "-",
       "CSV file diameter_m,passing_1: share of the mass that passes."},
      s.gradation);
  list.add_path({"shapes", "-", "Folder of shape files; empty: spheres."},
                s.shapes);
  list.add({"order", "-", "N_s: what the files have beyond is cut off."},
           s.order, between(1, dem::max_order));
  list.add({"seed", "-", "Seed of sizes, shapes, positions and orientations."},
           s.seed, between(0, 2147483647));
  list.add({"initial_solid_fraction", "-",
            "Solid fraction of the random cloud before compaction.",
            "random insertion jams above"},
           s.initial_solid_fraction, above(0., 0.35));
}

void add_preparation(List &list, PreparationParameters &p)
{
  list.in("Preparation");
  list.add({"target", "-",
            "pressure: at rest at the pressure, as dense as friction makes it; "
            "porosity: under the pressure friction is lowered until the "
            "porosity is met, then set back."},
           p.target, {"pressure", "porosity"});
  list.add({"pressure", "Pa", "Isotropic, at the end of the compaction."},
           p.pressure, above(0., 1e8));
  list.add({"porosity", "-", "Porosity of target = porosity, met to 0.005."},
           p.porosity, between(0.2, 0.8));
  list.add(
      {"friction", "-", "Particle on particle while compacting; low is dense."},
      p.friction, between(0., 10.));
  list.add({"wall_speed", "m/s", "Largest speed of a servo wall."},
           p.wall_speed, above(0., 100.));
  list.add({"local_damping", "-", "D_a: F - D_a |F| sgn(v) while compacting."},
           p.local_damping, below(0., 1.));
  list.add({"stress_tolerance", "-",
            "Stress of each axis may differ from the target by this share."},
           p.stress_tolerance, above(0., 0.5));
  list.add({"unbalanced_ratio", "-",
            "Largest unbalanced force ratio of a specimen at rest."},
           p.unbalanced_ratio, above(0., 0.1));
  list.add(
      {"max_time", "s", "The compaction fails if it is not at rest by then."},
      p.max_time, above(0., 1e4));
  list.add(
      {"safety", "-",
       "Above 0: share of the stable step while compacting, with the usual "
       "Contact/refresh_tolerance and skin, so that cases with "
       "others and other steps in Time share a specimen; 0: as Contact and "
       "Time say."},
      p.safety, between(0., 1.));
}
} // namespace spall
