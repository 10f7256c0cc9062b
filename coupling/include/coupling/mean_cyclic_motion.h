#pragma once

#include <coupling/exchange.h>
#include <coupling/triaxial_cell.h>
#include <dem/measure/network.h>

namespace coupling
{
/// Where all that moves stands at the end of a load cycle.
struct Pose
{
  std::vector<dem::Vec3> position;          ///< of the particles, by id [m]
  std::vector<dem::Quaternion> orientation; ///< of the particles
  std::vector<dem::Vec3> planes;            ///< their points [m]
  std::vector<dem::Vec3> nodes;             ///< of membrane and plate [m]
  double radius = 0.;                       ///< of a round side [m]
  dem::Vec3 cell = dem::Vec3::Zero();       ///< lengths of a periodic one [m]
};

Pose pose_of(const dem::Engine &engine, const TriaxialCell &cell);

/// Mean motion in a load cycle, from its end to the end of the next.
struct MeanCyclicMotion
{
  std::vector<dem::Vec3> shift;  ///< of the particles, by id [m]
  std::vector<dem::Vec3> turn;   ///< of the particles, rotation vectors [rad]
  std::vector<dem::Vec3> planes; ///< [m]
  std::vector<dem::Vec3> nodes;  ///< [m]
  double widening = 0.;          ///< of a round side [m]
  dem::Vec3 cell = dem::Vec3::Zero(); ///< lengths of a periodic one [m]
};

/// Between two poses `cycles` apart.
MeanCyclicMotion mean_motion_between(const Pose &from, const Pose &to,
                                     double cycles);

/// Particles without contact rattle in their pores: their drift becomes that of
/// the specimen around them, the affine motion that fits all other particles
/// best.
void calm_rattlers(const dem::Engine &engine, MeanCyclicMotion &mean_motion);

/// How far along a drift, and in how many steps of which length.
struct Way
{
  double cycles = 0.; ///< of the mean cyclic motion [-]
  int n_steps = 1;
  double time_step = 0.; ///< [s]
};

/// Moves particles, planes and cell along the mean cyclic motion: contacts
/// open, close, slide and turn as on any other way, but no force moves
/// anything. Ends early where the springs of the particles have come to hold
/// four times their energy. Particles and planes are at rest then. Returns the
/// cycles that were moved.
double move_along(const MeanCyclicMotion &mean_motion, const Way &way,
                  Exchange &exchange, TriaxialCell &cell, dem::Engine &engine);

void save(std::ostream &out, const Pose &pose);
void restore(std::istream &in, Pose &pose);
void save(std::ostream &out, const MeanCyclicMotion &mean_motion);
void restore(std::istream &in, MeanCyclicMotion &mean_motion);
} // namespace coupling
