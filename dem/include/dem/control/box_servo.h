#pragma once

#include <dem/engine.h>

#include <array>
#include <utility>

namespace dem
{
/// Three pairs of facing planes, the lower and the upper one of each axis.
using BoxPlanes = std::array<std::array<std::size_t, 2>, 3>;

/// Adds six planes round the box, facing inward.
BoxPlanes add_box(Engine &engine, const Vec3 &lower, const Vec3 &upper);

/// What bounds a specimen.
enum class EnclosureForm
{
  box,     ///< across each axis two planes, or two faces of the periodic cell
  cylinder ///< planes across z and the drum of the engine, without ends in
           ///< reach
};

/// The rigid walls all round a specimen, or its periodic cell.
struct SpecimenWalls
{
  SpecimenWalls(const BoxPlanes &of_box = {},
                EnclosureForm its_form = EnclosureForm::box)
      : planes(of_box), form(its_form)
  {
  }

  /// Of a cylinder the last pair alone, and none along a periodic axis.
  BoxPlanes planes;
  EnclosureForm form = EnclosureForm::box;

  bool is_round() const { return form == EnclosureForm::cylinder; }
};

/// Two planes and the cylinder between them, its axis in the middle of x and y.
SpecimenWalls add_cylinder(Engine &engine, const Vec3 &lower,
                           const Vec3 &upper);

/// Makes the scene periodic along these axes with this box as the cell, and
/// adds planes that face inward across the others.
SpecimenWalls
add_periodic_cell(Engine &engine, const Vec3 &lower, const Vec3 &upper,
                  const std::array<bool, 3> &axes = {true, true, true});

/// Distance of the two planes of each axis, or length of the cell; of a
/// cylinder diameter, diameter and height [m].
Vec3 box_size(const Engine &engine, const SpecimenWalls &walls);

/// The corners of the box of that size, lower and upper [m].
std::pair<Vec3, Vec3> box_corners(const Engine &engine,
                                  const SpecimenWalls &walls);

/// Volume between the walls [m^3].
double box_volume(const Engine &engine, const SpecimenWalls &walls);

/// Section across z [m^2].
double box_section(const Engine &engine, const SpecimenWalls &walls);

/// Mean compressive stress on the two planes of each axis or across the faces
/// of the cell, over the present faces; on a cylinder, over its side, for x and
/// y [Pa].
Vec3 box_stress(const Engine &engine, const SpecimenWalls &walls);

struct ServoParameters
{
  double response_time = 5e-4; ///< in which an error is to fall to 1/e [s]
  /// Of one plane or the side, the fastest; none goes through the skin of the
  /// lists in less than ten steps [m/s].
  double max_speed = 0.5;
  /// Share of `max_speed` that the planes of each axis may take: slender
  /// specimens keep their form while they are loose [-].
  Vec3 speed_share = Vec3::Ones();
  /// Where a load is followed: rate at which x and y give way when it shortens
  /// z, over the rate of that (Poisson's ratio of the aggregate) [-],
  double yielding = 0.3;
  /// and the share of the target up to which errors move no wall [-].
  double dead_band = 0.;
};

/// Moves the planes of chosen axes so that their stress follows a target:
/// speed = error / (2 stiffness response_time), both planes of an axis opposite
/// to each other. The stiffness is the affine estimate of the packing from its
/// present contacts, an upper bound, so the servo does not overshoot (at least
/// 50 times the target per strain, so that a loose packing is not rammed). The
/// stress is averaged over a fifth of the response time: without it the stiff
/// contacts at the wall would make the loop jump. A cylinder goes with axis 0.
class BoxServo
{
public:
  BoxServo(const SpecimenWalls &walls, const ServoParameters &parameters);

  /// Axis d follows this compressive stress [Pa].
  void follow(int d, double stress);
  /// Axis d shortens at this rate over its present length, whatever it meets
  /// [1/s].
  void move(int d, double rate);
  /// Axis d is left alone from now on; its planes stop.
  void release(Engine &engine, int d);
  /// From now on the sides meet a load on the ends: errors are summed, too,
  /// over twice the response time, so what moves the stress away for longer is
  /// found out; and x and y follow z by `yielding`, before there is
  /// an error at all.
  void follow_load() { follows_load = true; }
  /// Sets the speeds of the planes for the next step; the stiffness is taken
  /// again every 20 steps.
  void update(Engine &engine, double time_step);

  void save(std::ostream &out) const; ///< bit for bit
  void restore(std::istream &in);     ///< throws std::runtime_error

private:
  /// A pair of walls that moves as one.
  struct Pair
  {
    double area = 0.;   ///< that the stress acts on [m^2]
    double length = 0.; ///< that the speed shortens [m]
    double n_moving = 2.;
    double stiffness = 0.; ///< affine, for the strain of `length` [N m]
  };
  Pair pair(const Engine &engine, int d) const;
  double rate_of_load(const Engine &engine) const;
  double heeded_error(int d) const;
  void set_speed(Engine &engine, int d, double inward) const;

  SpecimenWalls walls;
  ServoParameters parameters;
  std::array<bool, 3> is_on = {false, false, false};
  std::array<bool, 3> is_moved = {false, false, false}; ///< at `rate`
  Vec3 rate = Vec3::Zero();                             ///< [1/s]
  Vec3 target = Vec3::Zero();                           ///< [Pa]
  Vec3 average = Vec3::Zero();   ///< stress, running [Pa]
  Vec3 stiffness = Vec3::Zero(); ///< affine_stiffness, last taken [N m]
  bool follows_load = false;
  Vec3 summed = Vec3::Zero(); ///< errors over the integral time [Pa]
};
} // namespace dem
