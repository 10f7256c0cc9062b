#pragma once

#include "specimen/specimen.h"

#include <dem/packing/insertion.h>

#include <string>
#include <vector>

namespace spall
{
/// Particles before they have an engine, and what they are called.
struct PlacedParticles
{
  ShapeLibrary shapes;                  ///< of all particles, each once
  std::vector<std::string> shape_names; ///< of `shapes`
  std::vector<dem::ParticleShape> body;
  std::vector<dem::Placement> placement;
  std::vector<dem::Vec3> velocity, spin; ///< [m/s], [rad/s]
  std::vector<std::uint8_t> material;    ///< 0 or 1, see place_particles()
  /// What a message calls each one: "particles.csv:7", "particle 12 of Fill".
  std::vector<std::string> name;
  dem::Vec3 box = dem::Vec3::Zero(); ///< upper corner, if the file has one [m]

  std::size_t size() const { return body.size(); }
};

/// Where a case names placed particles and the shapes that their file names.
struct PlacedSource
{
  std::string section; ///< with the keys `particles` and `shapes`
  std::string particles, shapes;
  int order = 0;                ///< N_s of the shapes
  bool has_other_solid = false; ///< material 1, `other`, is allowed
};

/// Reads the particles of a file, or the last state in the folder of a run
/// (particles.csv). Throws InputError with file and line.
PlacedParticles place_particles(const Case &parameters,
                                const PlacedSource &source);

/// Text of particles.csv: what place_particles() reads, in the order of the
/// ids. A particle that has broken has its first shape there and its present
/// equivalent radius; a comment says so.
std::string particle_table(const dem::ParticleSystem &all,
                           const PlacedParticles &as_placed);
} // namespace spall
