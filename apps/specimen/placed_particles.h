#pragma once

#include "specimen/shape_library.h"

#include <dem/engine.h>
#include <dem/packing/insertion.h>
#include <dem/packing/pouring.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace spall
{
/// Particles before they have an engine, and what they are called.
struct PlacedParticles
{
  ShapeLibrary shapes; ///< of all particles, each once
  std::vector<dem::ParticleShape> body;
  std::vector<dem::Placement> placement;
  std::vector<dem::Vec3> velocity, spin; ///< [m/s], [rad/s]
  std::vector<std::uint8_t> material;    ///< 0 or 1, see place_particles()
  /// What a message calls each one: "particles.csv:7", "particle 12 of Fill".
  std::vector<std::string> name;
  dem::Vec3 box = dem::Vec3::Zero(); ///< upper corner, if the file has one [m]
  /// Where the origin of the file, or of the walls of the case, is [m].
  dem::Vec3 origin = dem::Vec3::Zero();

  std::size_t size() const { return body.size(); }
  double smallest_radius() const; ///< of the equivalent spheres [m]
  /// Adds particles of a section at rest, the first `n_other` of material 1.
  void add_at_rest(const std::vector<dem::ParticleShape> &bodies,
                   const std::vector<dem::Placement> &at,
                   const std::string &section, std::size_t n_other = 0);
};

/// Where a case names placed particles and the shapes that their file names.
struct PlacedSource
{
  std::string section; ///< with the keys `particles` and `shapes`
  std::string particles, shapes;
  int order = 0; ///< N_s of the shapes
  /// What material 1, `other`, is: "section Other, which does not break";
  /// empty: there is none.
  std::string other_solid = {};
};

/// Reads the particles of a file, or the last state in the folder of a run:
/// its particles.csv, with the shapes in its folder `shapes`, which are taken
/// as they are. Throws InputError with file and line.
PlacedParticles place_particles(const Case &parameters,
                                const PlacedSource &source);

/// Adds the particles with their velocities to an engine without particles.
void add_particles(const PlacedParticles &from, dem::Engine &engine);

/// The same for a layer that is poured.
dem::PlacedLayer placed_layer(const PlacedParticles &from);

/// Which overlaps of placed particles are refused.
struct PlacedCheck
{
  std::string section;          ///< with the key `largest_overlap`
  double largest_overlap = 0.;  ///< over the radius of the smaller one [-]
  dem::EngineParameters engine; ///< of the test
  /// Adds what is around the particles.
  std::function<void(dem::Engine &)> add_boundaries;
};

/// Evaluates the contacts of the particles as placed, and returns the engine
/// with them and what is around, on one rank. Throws InputError with the names
/// of the two where particles, or a particle and a boundary, overlap by more.
std::unique_ptr<dem::Engine> check_as_placed(const Case &parameters,
                                             const PlacedParticles &particles,
                                             const PlacedCheck &check);
} // namespace spall
