#pragma once

#include <dem/boundary/facet_surface.h>
#include <dem/contact/law.h>
#include <dem/contact/side.h>

#include <cstdint>
#include <vector>

namespace dem
{
/// Load of one contact on both of its sides; zero while open.
struct ContactLoad
{
  Vec3 force = Vec3::Zero();    ///< on A, the opposite on B [N]
  Vec3 moment_a = Vec3::Zero(); ///< about the centre of A [N m]
  Vec3 moment_b = Vec3::Zero(); ///< about the centre of B [N m]
};

/// Contacts and contacts-to-be of one kind in columns; entry k of every column
/// is the same contact.
struct ContactBatch
{
  std::vector<std::int32_t> a; ///< stone
  std::vector<std::int32_t> b; ///< stone, or plane, or slot at the surface
  std::vector<SurfaceSide> side_a;
  std::vector<SurfaceSide> side_b;         ///< stone against stone only
  std::vector<HertzPrefactors> prefactors; ///< stone against stone only
  /// An open contact need not be looked at before the stones have travelled
  /// this far in all (ForceContext::travelled) [m].
  std::vector<double> wake;
  std::vector<double> twist; ///< turned about the normal since then [rad]
  std::vector<ContactHistory> history;
  std::vector<Dissipation> lost;
  std::vector<ContactLoad> load;
  std::vector<Vec3> normal;        ///< last, from A to B [-]
  std::vector<std::uint8_t> event; ///< bit 0: side A breaks, bit 1: side B

  std::size_t size() const { return a.size(); }
  bool is_touching(std::size_t k) const { return history[k].overlap > 0.; }

  void resize(std::size_t n);

  /// Entry `to` becomes entry `from` of another batch.
  void copy_entry(std::size_t to, const ContactBatch &other, std::size_t from);
};

/// Where a contact with the facet surface presses.
struct FacetSpot
{
  std::int32_t triangle = -1;
  std::array<double, 3> weight{}; ///< barycentric [-]
};
} // namespace dem
