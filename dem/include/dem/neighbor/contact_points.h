#pragma once

#include <dem/contact/common_normal.h>
#include <dem/shape/radius_map.h>

#include <span>
#include <vector>

namespace dem
{
/// A particle in the search for contact points.
struct MappedParticle
{
  const ParticleShape &body;
  const RadiusMap &map;
};

/// Two particles with the pose of B relative to A.
struct MappedPair
{
  MappedParticle a, b;
  RelativePose pose;
};

/// A slab between the hulls of two particles.
struct Separation
{
  Vec3 normal = Vec3::UnitZ(); ///< unit, from A to B, body frame of A [-]
  double gap = 0.; ///< between the hulls along it; < 0: they overlap [m]
  /// No point of A, or of B, is higher from its centre towards the other [m].
  double top_a = 0., top_b = 0.;
};

/// The widest slab between the hulls that a few steps find from a first guess
/// (Gilbert 1966); its gap is a lower bound of that between the particles.
/// Where this bound is below `skin` [m] and may not be tight, the tops along
/// the normal are found on the series.
Separation separate(const MappedPair &pair, const Vec3 &guess,
                    double skin = 0.);

/// Whether two particles overlap or come within `skin`, as far as the nodes
/// of their maps resolve [m].
bool may_touch(const MappedPair &pair, double skin);

/// Result of a search for the contact points of two particles.
struct ContactPointSearch
{
  std::vector<ContactPoint> contact_points; ///< overlap > -skin, nearest first
  int n_lost = 0; ///< minima of the maps without a lens of contact
};

/// All contact points of two particles within `skin` [m]: local
/// minima of the gap over the nodes of either particle inside the slab of
/// `separation` (of this pose), each followed to the common normal. Contact
/// points beside one of the `known` ones are left out.
ContactPointSearch
find_contact_points(const MappedPair &pair, const Separation &separation,
                    double skin, std::span<const ContactPoint> known = {});

/// Whether two contact points on particle A are one.
bool is_one_contact_point(const ContactPoint &one, const ContactPoint &other);

/// Heights along a normal from the centre of a particle [m].
struct SupportHeights
{
  double lowest = 0.; ///< that matters
  double wall = 0.;   ///< where the overlap begins
};

/// All points of a particle that are farthest along a unit vector of its body
/// frame among their neighbours and high enough. Points beside `known` ones
/// are left out.
std::vector<ContactPoint>
find_supports(const MappedParticle &particle, const Vec3 &normal,
              const SupportHeights &heights,
              std::span<const ContactPoint> known = {});
} // namespace dem
