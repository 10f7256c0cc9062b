#pragma once

#include <dem/contact/batch.h>
#include <dem/contact/elasticity_table.h>
#include <dem/contact/lost_energy.h>
#include <dem/contact/overlap_watch.h>
#include <dem/contact/pair_loads.h>
#include <dem/contact/range_sum.h>
#include <dem/contact/sum_grid.h>
#include <dem/parameters/engine.h>
#include <dem/particles/particle_system.h>

#include <functional>
#include <span>

namespace dem
{
/// No wall farther than this from the centre can touch the particle [m].
inline double wall_bound(const ParticleSystem &particles, std::size_t particle,
                         ContactGeometry geometry)
{
  return traits(geometry).reads_shape
             ? particles.shape[particle].circumscribed_radius
             : particles.radius(particle);
}

/// What every force loop reads, and the particles whose force and moment it
/// adds to.
struct ForceContext
{
  const EngineParameters &parameters;
  const ElasticityTable &elasticity;
  ParticleSystem &particles;
  double time_step = 0.; ///< [s]
  /// Sum over all steps of how far the fastest particle and boundary could have
  /// closed a gap [m].
  double path_length = 0.;
  double step_path = 0.; ///< of it, in the last step [m]
  /// PathLengths::gaps: of any two spheres. Where there are shapes
  /// ParticleSystem::path_length has it by particle.
  double gap_path = 0.;
  double cell_path = 0.; ///< PathLengths::cell [m]
  /// By the fastest vertex of boundaries that deform, over all steps [m].
  double deforming_path = 0.;
  /// Forces stay as the last step left them, only loads are added: after some
  /// contacts were reset.
  bool adds_loads_only = false;
  SumGrid grid = {}; ///< of loads
  /// No overlap up to this exceeds the recent ratios of OverlapRecord [m].
  double known_overlap = 0.;
};

/// Which columns the contacts of a scene need.
BatchLayout pair_layout(const EngineParameters &parameters,
                        const ParticleSystem &particles);
BatchLayout wall_layout(const EngineParameters &parameters,
                        const WallMaterial &wall,
                        const ParticleSystem &particles);

/// Dissipation of the loops and whether some side requests breakage
/// (ContactBatch::event).
struct ForceSum
{
  LostEnergy lost;
  double largest_force = 0.; ///< as RangeSum [N]
  bool wants_breakage = false;
  bool has_switched = false;  ///< as RangeSum
  bool has_displaced = false; ///< as RangeSum
  int n_jumps = 0;
  int n_ended = 0;
  double overlap_ratio = 0.;      ///< as RangeSum [-]
  Vec3 cell_force = Vec3::Zero(); ///< as RangeSum [N]

  ForceSum &operator+=(const ForceSum &part);
};

/// A boundary as one particle meets it at one contact: the plane through
/// `point`.
struct WallRow
{
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();         ///< from the particle to the wall [-]
  Vec3 velocity = Vec3::Zero();        ///< of the wall at the contact [m/s]
  Vec3 velocity_before = Vec3::Zero(); ///< where the contact was [m/s]
  Vec3 normal_before = Vec3::UnitZ();  ///< there [-]
  double inverse_mass = 0.;            ///< effective, of the wall [1/kg]
};

/// Particle against particle: rolling-resistant elliptic Hertz. Loads are added
/// to the particles by way of `loads`. `ranges` is space to work in.
ForceSum pair_forces(const ForceContext &context, ContactBatch &batch,
                     PairLoads &loads, std::vector<RangeSum> &ranges);

/// The walls of one kind as their contacts see them: `b` is the row.
struct Walls
{
  const WallMaterial &material;     ///< of all of them
  const std::vector<WallRow> &rows; ///< as they stand in this step
  /// Overlaps by row, where the contact points of particles that follow their
  /// surfaces were found before the forces (relocate_on_drum(),
  /// relocate_on_facets()) [m].
  std::span<const double> overlap = {};
  /// By row, where several facets may carry a contact: overlap beyond that with
  /// the plane of the row (FacetShares::extra) [m].
  std::span<const double> extra = {};
  /// Finds the contact point of contact k again, if they were.
  std::function<void(const ForceContext &, std::size_t)> relocate = {};
};

/// Particle against wall: by the law of the wall. Loads are added to the
/// particles.
ForceSum wall_forces(const ForceContext &context, const Walls &walls,
                     ContactBatch &batch, std::vector<RangeSum> &ranges);

/// Geometry and forces of contact k as they stand, no time passing: after one
/// of its particles has changed its shape. Springs are capped again; the energy
/// that they release is returned [J]. The loads of the particles are left
/// wrong: all loops must run again.
double reset_pair(const ForceContext &context, ContactBatch &batch,
                  std::size_t k);
double reset_wall(const ForceContext &context, const Walls &walls,
                  ContactBatch &batch, std::size_t k);
} // namespace dem
