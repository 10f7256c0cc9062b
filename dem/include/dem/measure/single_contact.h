#pragma once

#include <dem/boundary/facet_surface.h>
#include <dem/boundary/plane.h>
#include <dem/parameters/engine.h>
#include <dem/particles/particle_system.h>

#include <vector>

/// One contact evaluated by itself, for a test or a plug-in: through the
/// engine, so that its results are those of a run.
namespace dem
{
/// A particle as it stands and moves.
struct PosedParticle
{
  ParticleShape shape;
  Vec3 position = Vec3::Zero(); ///< of the origin of the shape [m]
  Quaternion orientation = Quaternion::Identity(); ///< body to world
  Vec3 velocity = Vec3::Zero();                    ///< [m/s]
  Vec3 spin = Vec3::Zero();                        ///< world frame [rad/s]
  /// 0: EngineParameters::particle; 1, 2, ...: EngineParameters::other_solids.
  std::uint8_t material = 0;
};

/// One point at which the two touch; A is the first particle.
struct LoadedContactPoint
{
  double overlap = 0.;         ///< [m]
  Vec3 normal = Vec3::UnitZ(); ///< from A to B, or to the boundary [-]
  Vec3 point = Vec3::Zero();   ///< [m]
  Vec3 force = Vec3::Zero();   ///< on A [N]
  double stored_energy = 0.;   ///< in all springs [J]
};

/// What A and B do to each other. Without contact there are no points, and all
/// loads are zero.
struct ContactState
{
  std::vector<LoadedContactPoint> points;
  ParticleLoad on_a; ///< force, and moment about the position of A
  /// The same on B, about its position; on a boundary about the origin.
  ParticleLoad on_b;
};

/// Evaluates two particles, a particle and a plane, or a particle and a facet
/// surface (law: EngineParameters::surface; the vertex loads are written to
/// FacetSurface::load). The contact geometry is that of
/// EngineParameters::geometry. Gravity, local damping and breakage are left
/// out. The contact is new: normal springs and all dashpots act in full,
/// tangential and rolling springs take up the motion of `time_step` [s].
ContactState evaluate_contact(const EngineParameters &parameters,
                              const PosedParticle &a, const PosedParticle &b,
                              double time_step = 0.);
ContactState evaluate_contact(const EngineParameters &parameters,
                              const PosedParticle &a, const Plane &plane,
                              double time_step = 0.);
ContactState evaluate_contact(const EngineParameters &parameters,
                              const PosedParticle &a, FacetSurface &surface,
                              double time_step = 0.);
} // namespace dem
