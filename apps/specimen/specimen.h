#pragma once

#include "case/case.h"
#include "specimen/shape_library.h"

#include <coupling/gain.h>
#include <dem/control/box_servo.h>
#include <dem/engine.h>
#include <dem/measure/assembly.h>
#include <fem/surface_mesh.h>

#include <memory>
#include <optional>
#include <vector>

namespace spall
{
/// Particles that are still to be placed, for what does not move: masses,
/// sizes, which of them break.
dem::ParticleSystem
unplaced_particles(const Case &parameters,
                   const std::vector<dem::ParticleShape> &particles);

/// The random cloud of particles in its box, before compaction.
struct Specimen
{
  ShapeLibrary shapes;                 ///< shared shapes, in order of file name
  std::unique_ptr<dem::Engine> engine; ///< particles and walls
  dem::SpecimenWalls walls;
};

/// The walls of section Walls that are not wholly in a box, or in the upright
/// cylinder in it, of this size about its middle: one line about the first of
/// them; empty: there is none.
std::string walls_beyond(const Case &parameters, const dem::Engine &engine,
                         const dem::Vec3 &middle, const dem::Vec3 &size);

/// Size of the box round the specimen after compaction, about [m].
dem::Vec3 nominal_size(const SpecimenParameters &specimen);

/// The lateral side of the specimen as a mesh for the membrane, between these
/// corners. The flat sides of a round one touch the cylinder.
fem::SurfaceMesh lateral_mesh(const Case &parameters, const dem::Vec3 &lower,
                              const dem::Vec3 &upper);

/// What the engine needs from the case, with the settings of preparation.
dem::EngineParameters engine_parameters(const Case &parameters);

/// Reads gradation and shapes, draws and inserts the particles. Throws
/// InputError.
Specimen make_specimen(const Case &parameters);

/// The step that a run starts with.
struct SetupStep
{
  double step = 0.; ///< [s]
  /// Longest for any one particle on one wall, and for one contact on any node
  /// of the membrane [s].
  double cap = 0.;
  /// With a membrane: of every_step at `step`, and of the window that the case
  /// asks for.
  std::optional<coupling::ExchangeGain> gain;
  coupling::WindowGain window;
  double membrane_step = 0.; ///< longest of the membrane alone [s]
};

/// `limit` and the lightest of all particles that will be there [kg];
/// `membrane` as it will be, null without one. Throws InputError if the fixed
/// step is above what one wall or the exchange with the membrane allows.
SetupStep choose_step(const Case &parameters, const dem::StepLimit &limit,
                      double lightest, const fem::Membrane *membrane);

/// Of a triaxial test: its membrane on a specimen of the nominal size.
SetupStep choose_step(const Case &parameters, const dem::StepLimit &limit,
                      double lightest);
} // namespace spall
