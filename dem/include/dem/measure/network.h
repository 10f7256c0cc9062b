#pragma once

#include <dem/engine.h>

#include <span>
#include <vector>

/// The contact network at one instant and its indicators: definitions and
/// sources in docs/theory/network.md.
namespace dem
{
/// Two particles that touch: one contact, whatever the number of contact
/// points.
struct PairContact
{
  std::int32_t a = 0, b = 0;
  Vec3 normal = Vec3::UnitZ(); ///< from A to B; mean of the points [-]
  Vec3 point = Vec3::Zero();   ///< mean over the contact points [m]
  Vec3 force = Vec3::Zero();   ///< on A [N]
  bool is_sliding = false;     ///< at the Coulomb limit, all contact points
};

/// A particle that touches a boundary.
struct WallContact
{
  std::int32_t particle = 0;
  Vec3 point = Vec3::Zero(); ///< [m]
  Vec3 force = Vec3::Zero(); ///< on the particle [N]
  /// Sum of force (x) point of the facets that carry it, less that of the whole
  /// force at its point [N m].
  Mat3 spread = Mat3::Zero();
  bool is_on_facets = false; ///< of a facet surface
};

struct Network
{
  std::vector<PairContact> pairs;
  /// Planes, drum, facet surfaces; also what has just ended and still pulls
  /// back what it gave too much.
  std::vector<WallContact> walls;
};

/// What touches now, after a step.
Network contact_network_of(const Engine &engine);

/// Where and along which normal two surfaces touch.
struct ContactFrame
{
  Vec3 point = Vec3::Zero();   ///< in the middle of the overlap [m]
  Vec3 normal = Vec3::UnitZ(); ///< from A to B [-]
};

/// Frame of contact k of Engine::pairs(), which touches.
ContactFrame pair_contact_frame(const Engine &engine, std::size_t k);

/// Where wall contact k of this batch of the engine presses [m].
Vec3 wall_contact_point(const Engine &engine, const ContactBatch &batch,
                        std::size_t k);

/// Fabric tensor (Satake 1982, Oda 1982) of the contact normals between
/// particles, sum n (x) n / C, trace 1; zero without contacts [-].
Mat3 fabric_tensor(std::span<const PairContact> pairs);

/// Second invariant of the deviator, sqrt(3/2 a:a) with a = 15/2 (phi - I/3)
/// (Kanatani 1984), of a fabric tensor phi [-]: 0 isotropic, 15/2 if all
/// normals are parallel.
double fabric_anisotropy(const Mat3 &fabric);

/// Contacts between particles at the Coulomb limit over all; 0 without [-].
double sliding_fraction(std::span<const PairContact> pairs);

/// Contacts between particles whose normal force is above the mean over all
/// (Radjai et al. 1998); 0 without [-].
double strong_share(std::span<const PairContact> pairs);

/// Mean stress of each particle, -1/V sum sym(F (x) (x_c - x)) over its
/// contacts with particles and walls; compression positive [Pa].
std::vector<Mat3> particle_stress(const ParticleSystem &particles,
                                  const Network &network);

/// Force chains (Peters et al. 2005).
struct ForceChains
{
  double share = 0.; ///< particles in chains over all particles [-]
  std::int64_t n_chains = 0;
  double mean_length = 0.; ///< particles in a chain; 0 without chains [-]
};

/// Chains of at least three touching particles whose major principal stress is
/// above the mean of the particles that bear, and whose contacts are within 45
/// degrees of the major axis of both particles; branches are part of their
/// chain.
ForceChains force_chains(const ParticleSystem &particles,
                         const Network &network);
} // namespace dem
