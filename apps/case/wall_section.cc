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

dem::Vec3 free_axes(FreeDirections free)
{
  switch (free)
  {
  case FreeDirections::none:
    break;
  case FreeDirections::x:
    return {1., 0., 0.};
  case FreeDirections::y:
    return {0., 1., 0.};
  case FreeDirections::z:
    return {0., 0., 1.};
  case FreeDirections::xy:
    return {1., 1., 0.};
  case FreeDirections::xz:
    return {1., 0., 1.};
  case FreeDirections::yz:
    return {0., 1., 1.};
  case FreeDirections::xyz:
    return {1., 1., 1.};
  }
  return dem::Vec3::Zero();
}

namespace
{
void add_motion(List &list, WallSection &w)
{
  list.add({"start", "s", "Time at which the motion of the wall begins."},
           w.start, between(0., 1e6));
  list.add({"velocity", "m/s", "Constant velocity of the wall."}, w.velocity);
  list.add(
      {"amplitude", "m",
       "Amplitude of a sinusoidal motion, which is added to the displacement."},
      w.amplitude);
  list.add({"frequency", "Hz",
            "Frequency of the sinusoidal motion and of force_amplitude."},
           w.frequency, between(0., 1e5));
  list.add_path(
      {"table", "-",
       "CSV file time_s,x_m,y_m,z_m of a displacement that is added. It is "
       "linear between the rows and constant after the last row."},
      w.table);
  list.add({"axis", "-",
            "Direction of the axis of rotation. Its length is arbitrary."},
           w.axis);
  list.add({"centre", "m",
            "Point on the axis of rotation, which moves with the wall."},
           w.centre);
  list.add({"rotation_rate", "rad/s",
            "Angular velocity about the axis, right-handed."},
           w.rotation_rate, between(-1e5, 1e5));
}

void add_drive(List &list, WallSection &w)
{
  list.add({"free", "-",
            "Directions in which forces move the wall instead of the "
            "prescribed motion. The forces are its weight, `force` and those "
            "of the particles."},
           w.free, {"none", "x", "y", "z", "xy", "xz", "yz", "xyz"});
  list.add({"mass", "kg", "Mass of a wall with free directions."}, w.mass,
           above(0., 1e9));
  list.add({"force", "N",
            "Constant force on a wall with free directions, in addition to its "
            "weight and the particles."},
           w.force);
  list.add({"force_amplitude", "N",
            "Peak of a haversine force at the frequency of this section, which "
            "is added to `force` as a cyclic load."},
           w.force_amplitude);
  list.add({"largest_speed", "m/s",
            "Largest speed along a free direction, as of a servo or hydraulic "
            "drive. The value 0 sets no limit."},
           w.largest_speed, between(0., 1e4));
  list.add({"inertia", "kg m^2",
            "Moment of inertia about the axis of a wall that torques rotate "
            "instead of rotation_rate. The value 0 switches this off."},
           w.inertia, between(0., 1e9));
  list.add({"torque", "N m",
            "Torque about the axis of a wall with a moment of inertia, in "
            "addition to that of the particles."},
           w.torque, between(-1e9, 1e9));
}
} // namespace

void add_walls(List &list, std::vector<WallSection> &walls)
{
  for (WallSection &wall : walls)
  {
    list.in(wall.section());
    list.add_path(
        {"mesh", "-", "Triangle mesh of the wall: STL, PLY, OBJ or gmsh file."},
        wall.mesh);
    list.add({"scale", "m", "Length of one unit of the mesh file."}, wall.scale,
             above(0., 1e3));
    list.add({"position", "m", "Position of the origin of the mesh file."},
             wall.position);
    list.add(
        {"particles", "-",
         "Side of the wall on which the particles are: outside or inside a "
         "closed mesh. The normals of an open mesh point to its outside."},
        wall.particles, {"outside", "inside"});
    add_law(list,
            {"law", "-",
             "Contact law of particles on this wall. The defaults of this key "
             "and of the next ones are the values of section Wall."},
            wall.material.law);
    add_wall(list, wall.material, between(0., 10.), "");
    add_motion(list, wall);
    add_drive(list, wall);
  }
}
} // namespace spall
