#pragma once

#include <dem/integrate/impact.h>
#include <dem/integrate/shared_bodies.h>
#include <dem/vector.h>

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace dem
{
/// Part of a body in the far side of a contact.
struct FarShare
{
  std::int32_t body = -1; ///< -1: unused
  double weight = 0.;     ///< of its motion [-]
};

/// Springs and dashpots of contacts between bodies, in columns: first the
/// particles, then points without rotation (nodes of a surface). A contact
/// joins particle `a` at `lever_a` with a particle at `lever_b` (weight 1),
/// with the weighted mean of points, or, without a share, with a wall at rest.
/// Where the contacts are spread over ranks, the functions below are collective
/// and see those of all ranks, once share_springs() has been called.
struct SpringNetwork
{
  std::vector<double> mass;    ///< of all bodies, finite [kg]
  std::vector<double> inertia; ///< of the particles [kg m^2]
  /// omega: springs that the points have besides, K <= omega^2 M [rad/s]
  double point_frequency = 0.;

  std::vector<std::int32_t> a;
  std::vector<std::array<FarShare, 4>> b;
  std::vector<Vec3> normal;              ///< unit [-]
  std::vector<Vec3> lever_a, lever_b;    ///< centre to contact [m]
  std::vector<double> normal_stiffness;  ///< [N/m]
  std::vector<double> shear_stiffness;   ///< [N/m]
  std::vector<double> rolling_stiffness; ///< [N m/rad]
  std::vector<double> normal_dashpot;    ///< [N s/m]
  std::vector<double> shear_dashpot;     ///< [N s/m]
  ForeseenImpact impact;                 ///< the shortest one

  std::vector<std::int64_t> id; ///< of the particles; empty: their rows
  std::int64_t n_ids = 0;       ///< above all of them
  /// Contacts of one kind end here, one kind after the other; empty: one kind.
  std::vector<std::size_t> kind_ends;
  std::shared_ptr<const SharedBodies> sharing =
      std::make_shared<SharedBodies>();

  std::size_t n_particles() const { return inertia.size(); }
  std::size_t n_bodies() const { return mass.size(); }
  std::size_t n_contacts() const { return a.size(); } ///< on this rank
  /// The same on all ranks: the id of a particle, and what is above all ids of
  /// a point.
  std::int64_t name_of(std::size_t body) const;
  std::int64_t first_point_name() const
  {
    return id.empty() ? static_cast<std::int64_t>(n_particles()) : n_ids;
  }
};

/// Contacts of all ranks, each once.
std::int64_t total_contacts(const SpringNetwork &network);

/// A step and the body that sets it.
struct NetworkStep
{
  double step = std::numeric_limits<double>::infinity(); ///< [s]
  std::int64_t body = -1; ///< SpringNetwork::name_of()
};

/// Velocity Verlet with dashpots that lag half a step is stable on springs K
/// and dashpots C, both symmetric and not negative, if and only if
/// lambda_max(M^-1 (dt^2 K + 2 dt C)) <= 4 (docs/theory/time_step.md).
///
/// guaranteed_step() never exceeds the largest such dt: each contact is split
/// between its bodies, |sum w d|^2 <= sum |w d|^2 / alpha with sum alpha = 1,
/// and the eigenvalues of single bodies bound the whole. Exact for one particle
/// on any number of walls and for two particles. Infinite without contacts.
NetworkStep guaranteed_step(const SpringNetwork &network);

/// The largest stable dt [s] by Lanczos iteration, which comes from below in
/// the eigenvalue, so from above in dt: no bound, but sharp to 1e-6 where the
/// iteration has converged. Infinite without contacts.
double sharp_step(const SpringNetwork &network);

/// The body of this name in words: mass, and what it touches.
std::string describe_body(const SpringNetwork &network, std::int64_t name);
} // namespace dem
