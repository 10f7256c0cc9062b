#pragma once

#include "specimen/container_mesh.h"
#include "specimen/specimen.h"

#include <dem/packing/pouring.h>
#include <fem/surface_mesh.h>

#include <optional>

namespace spall
{
/// The room in the mesh of Container/mesh, which is given. Throws InputError.
dem::Room room_in_mesh(const Case &parameters);

/// Container and particles of a vibratory compaction before anything is poured.
struct CompactionScene
{
  ShapeLibrary shapes;
  dem::Room room;
  std::vector<std::vector<dem::ParticleShape>> layers;
  std::optional<dem::PlacedLayer> placed; ///< of the only layer, unless drawn
  /// The particles as they will be, with their ids, nowhere in particular: for
  /// setup.
  dem::ParticleSystem all;
  /// A floor, which is plane 0, and an upright cylinder, or the mesh wall
  /// container_name alone; no particles.
  std::unique_ptr<dem::Engine> engine;
  dem::StepLimit limit; ///< for any one particle, and one node of the membrane
  SetupStep setup;
};

/// Reads gradation and shapes, draws the particles, chooses the first step.
/// Throws InputError.
CompactionScene make_compaction_scene(const Case &parameters);

dem::PouringParameters pouring_parameters(const FillingParameters &filling);

/// The flexible tube as it is built. Its flat sides touch the cylinder.
fem::Membrane make_tube(const Case &parameters);

/// Volume of the tube from z = 0 up to a height [m^3].
double volume_below(const fem::Membrane &tube, int elements_around,
                    double height);
} // namespace spall
