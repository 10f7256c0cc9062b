#pragma once

#include <dem/parameters/material.h>
#include <dem/shape/spherical_harmonics.h>
#include <dem/vector.h>

#include <string>

namespace spall
{
/// What a scene is and how long it is followed.
struct SceneParameters
{
  std::string particles;      ///< file of placed particles; may be empty
  std::string shapes;         ///< folder of the shape files that it names
  int order = dem::max_order; ///< N_s: at most this many degrees of the files
  dem::Vec3 gravity{0., 0., -9.81}; ///< [m/s^2]
  double duration = 1.;             ///< [s]
  double breakage_start = 0.;       ///< [s]
  double largest_overlap = 0.05;    ///< as placed, over the radius [-]
  int rows = 200;                   ///< of history.csv
  int frames = 20;                  ///< of particles and walls
  double checkpoint_every = 0.;     ///< 0: only at the end [s]
};

/// What closes a box along one axis.
enum class BoxFaces
{
  open,    ///< nothing
  rigid,   ///< a plane at each end
  periodic ///< what leaves at one end comes in at the other
};

struct SceneBoxParameters
{
  BoxFaces x = BoxFaces::open, y = BoxFaces::open, z = BoxFaces::open;
  dem::Vec3 lower = dem::Vec3::Zero(), upper = dem::Vec3::Ones(); ///< [m]
};

/// Particles that are drawn from a gradation and placed at random.
struct FillParameters
{
  double mass = 0.;      ///< 0: none [kg]
  std::string gradation; ///< CSV: diameter_m, passing_1
  std::string shapes;    ///< folder of shape files; empty: spheres
  int order = dem::max_order;
  int seed = 1;
  dem::Vec3 lower = dem::Vec3::Zero(), upper = dem::Vec3::Ones(); ///< [m]
};

/// All of the kind `scene`: Case::own<SceneCase>().
struct SceneCase
{
  SceneParameters scene;
  SceneBoxParameters box;
  FillParameters fill;
  dem::SolidMaterial other; ///< of placed particles of material `other`
};
} // namespace spall
