#pragma once

#include "case/checks.h"
#include "specimen/placed_particles.h"

#include <dem/packing/pouring.h>

namespace spall
{
/// Of a container in history.csv.
constexpr const char *container_name = "container";

/// What is poured into a container.
struct ContainerFilling
{
  double height = 0.;      ///< that the particles fill [m]
  double solid_share = 0.; ///< of the volume up to there [-]
  int layers = 1;
  double cloud_fraction = 1.; ///< solid fraction of a layer that falls [-]
};

/// The room in the mesh of Container/mesh, which is given, on a floor at z = 0.
/// Its collar is so high that a layer can fall through it. Throws InputError on
/// a file that is no container.
dem::Room container_room(const Case &parameters, dem::ContainerBottom bottom,
                         const ContainerFilling &filling);

/// A boundary of the contacts of section Wall.
void add_container(const Case &parameters, const dem::Room &room,
                   dem::Engine &engine);

/// The key of the height that particles fill.
struct FilledHeight
{
  const char *section, *key;
  double value = 0.; ///< [m]
};

// Checks of Container/mesh against the rest of a case. They throw InputError.

/// The height is at most that of the rim; the wall does not attract.
void check_container(const Case &c, const SourceLocation &location,
                     const dem::Container &container,
                     const FilledHeight &height);
/// It is so many times as wide as the largest particle of a gradation; `times`
/// in words.
void check_container_width(const Case &c, const SourceLocation &location,
                           const dem::Container &container,
                           const Gradation &gradation,
                           std::pair<double, const char *> times);
/// Particles have their centres inside as placed.
void check_inside(const Case &c, const PlacedParticles &particles,
                  const dem::Container &container);
} // namespace spall
