#pragma once

#include <dem/engine.h>

#include <array>

namespace dem
{
/// Three pairs of facing planes, the lower and the upper one of each axis.
using BoxPlanes = std::array<std::array<std::size_t, 2>, 3>;

/// Adds six planes round the box, facing inward.
BoxPlanes add_box(Engine &engine, const Vec3 &lower, const Vec3 &upper);

/// Distance of the two planes of each axis [m].
Vec3 box_size(const Engine &engine, const BoxPlanes &planes);

/// Mean compressive stress on the two planes of each axis, over the present
/// faces of the box [Pa].
Vec3 box_stress(const Engine &engine, const BoxPlanes &planes);

struct ServoParameters
{
  double response_time = 5e-4; ///< in which an error is to fall to 1/e [s]
  double max_speed = 0.5;      ///< of one plane [m/s]
};

/// Moves the planes of chosen axes so that their stress follows a target:
/// speed = error / (2 stiffness response_time), both planes of an axis opposite
/// to each other. The stiffness is the affine estimate of the packing from its
/// present contacts, an upper bound, so the servo does not overshoot (at least
/// 50 times the target per strain, so that a loose packing is not rammed). The
/// stress is averaged over a fifth of the response time: without it the stiff
/// contacts at the wall would make the loop jump.
class BoxServo
{
public:
  BoxServo(const BoxPlanes &planes, const ServoParameters &parameters);

  /// Axis d follows this compressive stress [Pa].
  void follow(int d, double stress);
  /// Axis d is left alone from now on; its planes stop.
  void release(Engine &engine, int d);
  /// Sets the speeds of the planes for the next step; the stiffness is taken
  /// anew every 20 steps.
  void update(Engine &engine, double time_step);

  void save(std::ostream &out) const; ///< bit for bit
  void restore(std::istream &in);     ///< throws std::runtime_error

private:
  BoxPlanes planes;
  ServoParameters parameters;
  std::array<bool, 3> is_on = {false, false, false};
  Vec3 target = Vec3::Zero();    ///< [Pa]
  Vec3 average = Vec3::Zero();   ///< stress, running [Pa]
  Vec3 stiffness = Vec3::Zero(); ///< affine_stiffness, last taken [N m]
};
} // namespace dem
