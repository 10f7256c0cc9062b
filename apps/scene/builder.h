#pragma once

#include "scene/case.h"
#include "specimen/placed_particles.h"

#include <dem/engine.h>

#include <memory>
#include <string>
#include <vector>

namespace spall
{
/// Reads the placed particles and draws those of the filling. Throws
/// InputError.
PlacedParticles make_scene_particles(const Case &parameters);

/// The planes of the box of a scene by name: "x_min".
struct BoxPlane
{
  std::string name;
  std::size_t plane = 0;
};

/// The engine with all of a scene in it, and its box.
struct BuiltScene
{
  std::unique_ptr<dem::Engine> engine;
  std::vector<BoxPlane> box;
};
BuiltScene build_scene(const Case &parameters, const PlacedParticles &particles,
                       std::shared_ptr<dem::Ranks> ranks);

/// What is known of a scene before its first step.
struct SceneStart
{
  /// Longest step of any particle on the box and on any wall
  /// (dem::critical_step).
  dem::StepLimit limit;
  double kinetic = 0., elastic = 0.; ///< energies of the particles [J]
};

/// Evaluates the contacts of the scene as placed. Throws InputError with the
/// names of the two where particles, or a particle and a wall, overlap by more
/// than Scene/largest_overlap.
SceneStart check_scene_as_placed(const Case &parameters,
                                 const PlacedParticles &particles);
} // namespace spall
