#include "case/list.h"
#include "scene/case.h"
#include "scene/kind.h"

namespace spall
{
namespace
{
void add_scene_section(List &list, SceneParameters &s)
{
  list.in("Scene");
  add_placed_particles(list, s, "there are none.");
  list.add_path({"shapes", "-",
                 "Folder of the shape files that the placed particles name."},
                s.shapes);
  list.add({"order", "-",
            "Order N_s of the spherical-harmonic series. Higher terms of the "
            "files are omitted."},
           s.order, between(1, dem::max_order));
  list.add({"gravity", "m/s^2", "Acceleration of gravity."}, s.gravity,
           between(-1e6, 1e6));
  list.add({"duration", "s", "Simulated time of the scene."}, s.duration,
           above(0., 1e6))
      .may_change = true;
  list.add({"breakage_start", "s", "Time from which particles can break."},
           s.breakage_start, between(0., 1e6));
  list.in("Scene", {.may_change = true});
  list.add(
      {"rows", "-", "Number of rows of history.csv in the simulated time."},
      s.rows, between(1, 1e7));
  list.add({"frames", "-",
            "Number of ParaView frames in the simulated time. The value 0 "
            "writes the first and the last."},
           s.frames, between(0, 1e6));
  list.add({"checkpoint_every", "s",
            "Simulated time between checkpoints. The value 0 writes one at the "
            "end only."},
           s.checkpoint_every, between(0., 1e6));
}

void add_box(List &list, SceneBoxParameters &b)
{
  list.in("Box");
  const std::vector<std::string> faces = {"open", "rigid", "periodic"};
  const std::string sentence =
      "Faces of the box normal to this axis: open, rigid planes with the "
      "contacts of section Wall, or periodic.";
  list.add({"x", "-", sentence}, b.x, faces);
  list.add({"y", "-", sentence}, b.y, faces);
  list.add({"z", "-", sentence}, b.z, faces);
  list.add({"lower", "m", "Lower corner of the box."}, b.lower, {},
           usual_corners);
  list.add({"upper", "m", "Upper corner of the box."}, b.upper, {},
           usual_corners);
}

void add_fill(List &list, FillParameters &f)
{
  list.in("Fill");
  list.add({"mass", "kg",
            "Mass of the particles that are drawn and placed at random without "
            "overlap. With the value 0 there are none."},
           f.mass, between(0., 1e6));
  add_drawn_particles(list, f);
  list.add({"lower", "m", "Lower corner of the region that is filled."},
           f.lower, {}, usual_corners);
  list.add({"upper", "m", "Upper corner of the region that is filled."},
           f.upper, {}, usual_corners);
}

void add_other(List &list, dem::SolidMaterial &other)
{
  list.in("Other");
  list.add({"density", "kg/m^3", "Mass density of the other material."},
           other.density, above(0., 3e4), usual_densities);
  list.add({"shear_modulus", "Pa",
            "Shear modulus of the other material. Its friction and damping are "
            "those of section Particle."},
           other.shear_modulus, between(1., 1e13), usual_moduli);
  list.add({"poisson_ratio", "-", "Poisson's ratio of the other material."},
           other.poisson_ratio, below(0., 0.5));
}
} // namespace

void add_scene(List &list, Case &of)
{
  auto &own = of.own<SceneCase>();
  add_scene_section(list, own.scene);
  add_box(list, own.box);
  add_fill(list, own.fill);
  add_other(list, own.other);
}
} // namespace spall
