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
  list.add_path({"particles", "-",
                 "CSV file with one particle per row: x,y,z and radius or "
                 "diameter, and any of qw,qx,qy,qz (orientation), vx,vy,vz, "
                 "wx,wy,wz, shape, material. Or the folder of a run of this "
                 "kind, whose last state is taken. Empty: none."},
                s.particles);
  list.add_path({"shapes", "-", "Folder of the shape files that it names."},
                s.shapes);
  list.add({"order", "-", "N_s: what the files have beyond is cut off."},
           s.order, between(1, dem::max_order));
  list.add({"gravity", "m/s^2", "Acceleration of gravity."}, s.gravity,
           between(-1e6, 1e6));
  list.add({"duration", "s", "Simulated time."}, s.duration, above(0., 1e6))
      .may_change = true;
  list.add({"breakage_start", "s", "Time from which particles may break."},
           s.breakage_start, between(0., 1e6));
  list.add({"largest_overlap", "-",
            "Largest overlap of particles as placed, over the radius of the "
            "smaller one."},
           s.largest_overlap, between(0., 0.5));
  list.in("Scene", {.may_change = true});
  list.add({"rows", "-", "Rows of history.csv."}, s.rows, between(1, 1e7));
  list.add({"frames", "-", "Frames for ParaView; 0: first and last."}, s.frames,
           between(0, 1e6));
  list.add({"checkpoint_every", "s",
            "Simulated time between checkpoints; 0: only at the end."},
           s.checkpoint_every, between(0., 1e6));
}

void add_box(List &list, SceneBoxParameters &b)
{
  list.in("Box");
  const std::vector<std::string> faces = {"open", "rigid", "periodic"};
  const std::string sentence = "Faces of the box along this axis: open, rigid "
                               "planes of section Wall, or periodic.";
  list.add({"x", "-", sentence}, b.x, faces);
  list.add({"y", "-", sentence}, b.y, faces);
  list.add({"z", "-", sentence}, b.z, faces);
  list.add({"lower", "m", "Lower corner of the box."}, b.lower);
  list.add({"upper", "m", "Upper corner of the box."}, b.upper);
}

void add_fill(List &list, FillParameters &f)
{
  list.in("Fill");
  list.add({"mass", "kg",
            "Mass of particles that are drawn and placed at random without "
            "overlap; 0: none."},
           f.mass, between(0., 1e6));
  add_drawn_particles(list, f);
  list.add({"lower", "m", "Lower corner of the region that is filled."},
           f.lower);
  list.add({"upper", "m", "Upper corner of the region that is filled."},
           f.upper);
}

void add_other(List &list, dem::SolidMaterial &other)
{
  list.in("Other");
  list.add({"density", "kg/m^3", "Density."}, other.density, above(0., 3e4));
  list.add({"shear_modulus", "Pa",
            "Shear modulus. Friction and damping are those of Particle."},
           other.shear_modulus, between(1., 1e13));
  list.add({"poisson_ratio", "-", "Poisson's ratio."}, other.poisson_ratio,
           below(0., 0.5));
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
