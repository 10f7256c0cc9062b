#pragma once

#include <dem/contact/forces.h>
#include <dem/contact/lost_energy.h>
#include <dem/neighbor/candidate_pair.h>
#include <dem/neighbor/particle_maps.h>

namespace dem
{
/// What happened to contacts that follow the true surfaces, since construction.
struct ContactPointEvents
{
  std::int64_t n_scans = 0; ///< pairs searched for contact points
  std::int64_t n_late = 0;  ///< found when they overlapped already
  /// Under load, moved to another contact point in one step.
  std::int64_t n_jumps = 0;
  /// Under load, lost their contact point: a lens went flat.
  std::int64_t n_ended = 0;
  std::int64_t n_merged = 0;   ///< moved to the contact point of another one
  std::int64_t n_unlisted = 0; ///< one too many for the pair
  std::int64_t n_lost = 0;     ///< minima of the maps without a contact point

  ContactPointEvents &operator+=(const ContactPointEvents &part);
};

/// Largest number of contact points of a pair, or of a particle and a plane.
inline constexpr std::size_t most_contact_points = 8;

/// Whether a contact has come to another contact point, or lost its own.
bool have_displaced(const ContactBatch &batch);

/// What the lists of contact points are made from.
struct ContactPointSearchInput
{
  const ForceContext &context;
  const ParticleMaps &maps;
  BatchLayout layout;
  double skin = 0.;      ///< contact points within it are listed [m]
  double notice = 0.;    ///< path length until the lists are checked again [m]
  bool is_first = false; ///< overlaps that are there now count in full
};

/// The list of the contact points of particles within the skin, by pair.
/// Every pair is searched again when its own particles have moved as far as the
/// last search is good for, or when a contact of it has lost its contact point.
/// Contacts keep all they carry and their order; a new one that overlaps
/// already starts with no force.
class ContactPointLists
{
public:
  void renew_pairs(const ContactPointSearchInput &input,
                   const PathLengths &paths, ContactBatch &batch,
                   LostEnergy &retired);
  /// The same for pairs of which a contact has displaced, while the other lists
  /// hold. Returns whether all other contacts are where they were in the batch.
  bool renew_displaced(const ContactPointSearchInput &input,
                       const PathLengths &paths, ContactBatch &batch,
                       LostEnergy &retired);

  /// Whether renew_pairs() with this skin [m] would search for pairs.
  bool needs_search(double skin, const PathLengths &paths) const
  {
    return reach < paths.centres + skin;
  }
  /// Distance between bounding spheres up to which it would do so [m].
  static double search_range(const ParticleSystem &particles, double skin);
  /// Searches now. Ghosts must be there up to search_range().
  void search(const ParticleSystem &particles, double skin,
              const PathLengths &paths);
  /// Marks the particles that some pair names, by row.
  std::vector<std::uint8_t> named(std::size_t n_particles) const;
  std::vector<CandidatePair> &candidates() { return pairs; }

  /// Particles have been added.
  void forget() { reach = -1.; }
  /// The particles have got other numbers.
  void renumber(const std::vector<std::int32_t> &new_row);
  ContactPointEvents events;

  /// Calls call(value) or call(column) for all that a checkpoint stores.
  template <class Self, class Value, class Column>
  static void visit(Self &self, const Value &value, const Column &column)
  {
    value(self.events);
    value(self.reach);
    column(self.pairs);
  }

private:
  std::vector<CandidatePair> pairs; ///< sorted
  double reach = -1.; ///< PathLengths::centres that `pairs` is good for [m]
};
} // namespace dem
