#pragma once

#include <dem/contact/forces.h>
#include <dem/neighbor/candidate_pair.h>
#include <dem/neighbor/particle_maps.h>

namespace dem
{
/// What happened to contacts that follow the true surfaces, since construction.
struct ContactPointEvents
{
  std::int64_t n_scans = 0;  ///< pairs searched for places
  std::int64_t n_late = 0;   ///< found when they overlapped already
  std::int64_t n_jumps = 0;  ///< under load, led to another place in one step
  std::int64_t n_ended = 0;  ///< under load, lost their place: a lens went flat
  std::int64_t n_merged = 0; ///< had come to the place of another one
  std::int64_t n_unlisted = 0; ///< one too many for the pair
  std::int64_t n_lost = 0;     ///< minima of the maps that led to no place

  ContactPointEvents &operator+=(const ContactPointEvents &part);
};

/// Most places that a pair, or a particle on a plane, may touch at.
inline constexpr std::size_t most_contact_points = 8;

/// Whether a contact has come to another place, or lost its own.
bool have_displaced(const ContactBatch &batch);

/// What the lists of places are made from.
struct ContactPointSearchInput
{
  const ForceContext &context;
  const ParticleMaps &maps;
  BatchLayout layout;
  double skin = 0.;      ///< places within it are listed [m]
  double notice = 0.;    ///< path length until the lists are checked again [m]
  bool is_first = false; ///< overlaps that are there now count in full
};

/// The list of the places where particles meet, or nearly do, by pair.
/// Every pair is searched again when its own particles have moved as far as the
/// last search is good for, or when a contact of it has lost its place.
/// Contacts keep all they carry and their order; a new one that overlaps
/// already starts with no force.
class ContactPointLists
{
public:
  void renew_pairs(const ContactPointSearchInput &input,
                   const PathLengths &paths, ContactBatch &batch,
                   Dissipation &retired);

  /// Particles have been added.
  void forget() { reach = -1.; }
  /// The particles have got other numbers.
  void renumber(const std::vector<std::int32_t> &place);
  ContactPointEvents events;

  /// Calls call(value) or call(column) for all that a checkpoint keeps.
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
