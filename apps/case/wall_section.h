#pragma once

#include <dem/boundary/wall_mesh.h>
#include <dem/parameters/material.h>
#include <dem/vector.h>

#include <string>

namespace spall
{
/// In which directions forces move a wall.
enum class FreeDirections
{
  none,
  x,
  y,
  z,
  xy,
  xz,
  yz,
  xyz
};

/// 1 along each axis in which forces move a wall, else 0.
dem::Vec3 free_axes(FreeDirections free);

/// A rigid wall of any shape: section Walls/NAME.
struct WallSection
{
  std::string name;
  std::string mesh;                       ///< file of triangles
  double scale = 1.;                      ///< unit of the file [m]
  dem::Vec3 position = dem::Vec3::Zero(); ///< of the origin of the file [m]
  dem::WallSide particles = dem::WallSide::outside;
  dem::WallMaterial material;              ///< of section Wall, unless given
  double start = 0.;                       ///< of the motion [s]
  dem::Vec3 velocity = dem::Vec3::Zero();  ///< [m/s]
  dem::Vec3 amplitude = dem::Vec3::Zero(); ///< of a sine [m]
  double frequency = 0.;                   ///< of the sine [Hz]
  std::string table;                       ///< file: time, displacement
  dem::Vec3 axis = dem::Vec3::UnitZ();     ///< of rotation, any length [-]
  dem::Vec3 centre = dem::Vec3::Zero();    ///< of rotation [m]
  double rotation_rate = 0.;               ///< [rad/s]
  FreeDirections free = FreeDirections::none;
  double mass = 1.;                              ///< where it is free [kg]
  dem::Vec3 force = dem::Vec3::Zero();           ///< besides its weight [N]
  dem::Vec3 force_amplitude = dem::Vec3::Zero(); ///< of a haversine [N]
  double largest_speed = 0.; ///< along a free direction; 0: any [m/s]
  double inertia = 0.;       ///< free rotation; 0: none [kg m^2]
  double torque = 0.;        ///< about the axis [N m]

  std::string section() const { return "Walls/" + name; }
};

/// Whether a section is that of a wall, and of which one.
inline bool is_wall_section(const std::string &section)
{
  return section.starts_with("Walls/");
}
inline std::string wall_of(const std::string &section)
{
  return section.substr(std::string("Walls/").size());
}

/// Letters, digits and underscores, at most 40.
bool is_wall_name(const std::string &name);
} // namespace spall
