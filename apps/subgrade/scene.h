#pragma once

#include "case/case.h"
#include "specimen/specimen.h"

#include <coupling/exchange.h>
#include <coupling/rigid_body.h>
#include <coupling/solid_body.h>
#include <dem/integrate/time_step.h>
#include <dem/measure/region_stress.h>
#include <dem/packing/pouring.h>

#include <memory>
#include <optional>

namespace spall
{
/// The particles and where they will be poured: above z = 0 between four rigid
/// planes or in a mesh.
struct ParticleBox
{
  ShapeLibrary shapes;
  std::vector<std::vector<dem::ParticleShape>> layers; ///< to be poured
  std::optional<dem::PlacedLayer> placed; ///< of the only layer, unless drawn
  dem::ParticleSystem all;                ///< the same, nowhere yet: for setup
  dem::Room room;
  std::unique_ptr<dem::Engine> engine; ///< sides; no particles, no bodies
  dem::StepLimit limit;
};

/// Throws InputError.
ParticleBox make_particle_box(const Case &parameters);

dem::PouringParameters pouring_parameters(const Case &parameters);

/// Lower face and sides of the plate, its lower face at this height [m].
fem::SurfaceMesh plate_surface(const LoadPlateParameters &plate, double height);
fem::PlateBodyParameters plate_body(const LoadPlateParameters &plate,
                                    double height);

/// Height at which the plate touches no particle yet, right above them [m].
double height_above(const dem::Engine &engine,
                    const LoadPlateParameters &plate);

/// The space right below the plate: from `low`, the ground, up to `high`, the
/// plate [m].
dem::Prism column_below(const LoadPlateParameters &plate, double low,
                        double high);

/// One contact on the lightest node of the ground through a window [s].
coupling::WindowGain ground_gain(const Case &parameters,
                                 const coupling::DeformableBody &ground,
                                 double smallest_particle, double window);

/// Steps of the particles in a window: those given, and where windows adapt no
/// more than half the limit of one pass and the explicit steps of the ground
/// allow.
int stable_particle_steps(const Case &parameters,
                          const coupling::DeformableBody &ground,
                          double smallest_particle, double time_step);

/// What the exchange with the ground stands at this step of the particles.
SetupStep ground_setup(const Case &parameters,
                       const coupling::DeformableBody &ground,
                       double smallest_particle, double time_step,
                       int particle_steps);
/// Throws InputError if that is not stable.
void check_ground_setup(const Case &parameters, const SetupStep &setup,
                        int particle_steps);
} // namespace spall
