#include "case/wall_section.h"

#include "case/list.h"

#include <algorithm>
#include <cctype>

namespace spall
{
bool is_wall_name(const std::string &name)
{
  constexpr std::size_t longest = 40;
  return !name.empty() && name.size() <= longest &&
         std::ranges::all_of(name, [](unsigned char c)
                             { return std::isalnum(c) || c == '_'; });
}

namespace
{
void add_motion(List &list, WallSection &w)
{
  list.add({"start", "s", "Time at which the motion begins."}, w.start,
           between(0., 1e6));
  list.add({"velocity", "m/s", "Constant velocity of the wall."}, w.velocity);
  list.add({"amplitude", "m",
            "Amplitude of a sine, which is added to the displacement."},
           w.amplitude);
  list.add(
      {"frequency", "Hz", "Frequency of the sine, and of force_amplitude."},
      w.frequency, between(0., 1e5));
  list.add_path({"table", "-",
                 "CSV file time_s,x_m,y_m,z_m: a displacement, which is added; "
                 "linear between the rows and constant after the last."},
                w.table);
  list.add({"axis", "-", "Axis of the rotation, of any length."}, w.axis);
  list.add({"centre", "m", "A point of the axis; it moves with the wall."},
           w.centre);
  list.add({"rotation_rate", "rad/s",
            "Rate of rotation about the axis, right-handed."},
           w.rotation_rate, between(-1e5, 1e5));
}

void add_drive(List &list, WallSection &w)
{
  list.add({"free", "-",
            "Directions in which forces move the wall instead of the motion "
            "above: its weight, `force` and the particles."},
           w.free, {"none", "x", "y", "z", "xy", "xz", "yz", "xyz"});
  list.add({"mass", "kg", "Mass of a wall with free directions."}, w.mass,
           above(0., 1e9));
  list.add({"force", "N",
            "Force on a wall with free directions besides its weight and the "
            "particles."},
           w.force);
  list.add({"force_amplitude", "N",
            "Peak of a haversine of this frequency, which is added to `force`: "
            "a cyclic load."},
           w.force_amplitude);
  list.add({"largest_speed", "m/s",
            "Largest speed along a free direction, as of a servo or hydraulic "
            "drive; 0: any."},
           w.largest_speed, between(0., 1e4));
  list.add({"inertia", "kg m^2",
            "Moment of inertia about the axis of a wall that torques turn "
            "instead of rotation_rate; 0: none."},
           w.inertia, between(0., 1e9));
  list.add({"torque", "N m",
            "Torque about the axis of a wall with a moment of inertia, besides "
            "that of the particles."},
           w.torque, between(-1e9, 1e9));
}
} // namespace

void add_walls(List &list, std::vector<WallSection> &walls)
{
  for (WallSection &wall : walls)
  {
    list.in(wall.section());
    list.add_path(
        {"mesh", "-", "Mesh of triangles: STL, PLY, OBJ or gmsh file."},
        wall.mesh);
    list.add({"scale", "m", "Length of a unit of the mesh file."}, wall.scale,
             above(0., 1e3));
    list.add({"position", "m", "Where the origin of the mesh file is."},
             wall.position);
    list.add({"particles", "-",
              "Side of the particles: outside or inside of a closed mesh; of "
              "an open one, where the normals of its triangles point, or "
              "behind them."},
             wall.particles, {"outside", "inside"});
    add_law(list,
            {"law", "-",
             "Law of particles on this wall. Default of this key and of the "
             "next ones: section Wall."},
            wall.material.law);
    add_wall(list, wall.material, between(0., 10.), "");
    add_motion(list, wall);
    add_drive(list, wall);
  }
}
} // namespace spall
