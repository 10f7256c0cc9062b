#pragma once

#include <dem/parameters/material.h>
#include <dem/particles/particle_system.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace dem
{
/// Two particles, the junior first (ParticleSystem::is_junior).
using PairKey = std::pair<std::int32_t, std::int32_t>;

/// Path lengths of a pair: sums over all steps of how far two particles can
/// have come nearer, upper bounds [m].
struct PathLengths
{
  double centres = 0.; ///< their centres, and so all that is round them
  /// What the contact geometry compares, at most; where there are shapes
  /// ParticleSystem::path_length has it by particle, and `cell` comes to it.
  double gaps = 0.;
  double cell = 0.; ///< images of a periodic cell against each other
};

/// All pairs of particles whose circumscribed spheres come within `skin` of
/// each other [m], sorted. In a periodic cell the nearest images count; throws
/// std::runtime_error where the cell is so short that a particle could meet two
/// images of another one.
std::vector<PairKey> near_spheres(const ParticleSystem &particles, double skin);

/// Largest `skin` of a search in which no particle can meet two images of
/// another one [m]; infinite without a periodic cell.
double widest_range(const ParticleSystem &particles);

/// Finds the pairs of particles with a gap below `skin`: between the spheres,
/// or between the radii along the branch. Keeps a wider list of candidates,
/// each with bounds of the gap that it had and the path length of its particles
/// then, so that most rebuilds need neither a grid nor a shape. What
/// it finds does not depend on what it keeps.
class PairFinder
{
public:
  /// All pairs with a gap below `skin` [m], sorted.
  std::vector<PairKey> find(const ParticleSystem &particles,
                            ContactGeometry geometry, double skin,
                            const PathLengths &paths);

  /// Whether find() of this `skin` [m] would search for candidates.
  bool needs_search(double skin, const PathLengths &paths) const
  {
    return reach < paths.centres + skin;
  }
  /// Distance between bounding spheres up to which it would do so [m].
  static double search_range(const ParticleSystem &particles, double skin);
  /// Searches now. Ghosts must be there up to search_range().
  void search(const ParticleSystem &particles, ContactGeometry geometry,
              double skin, const PathLengths &paths);
  /// Marks the particles that some candidate names, by row.
  std::vector<std::uint8_t> named(std::size_t n_particles) const;
  /// The particles have got other rows.
  void renumber(const std::vector<std::int32_t> &new_row);

  /// The particles have got other numbers or were added to.
  void forget()
  {
    candidates.clear();
    reach = -1.;
  }

private:
  struct Candidate
  {
    PairKey particles;
    /// With t the path length of the two, their gap is at least
    /// `least` - t and at most `most` + t [m].
    double least = 0., most = 0.;
  };
  static Candidate between_spheres(const ParticleSystem &particles,
                                   const PairKey &pair, double path_length);

  std::vector<Candidate> candidates; ///< sorted
  /// PathLengths::centres up to which pairs below it less that are all there
  /// [m].
  double reach = -1.;
};
} // namespace dem
