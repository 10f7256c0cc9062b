#pragma once

#include "case.h"

#include <coupling/gain.h>
#include <dem/boundary/box_servo.h>
#include <dem/engine.h>

#include <memory>
#include <vector>

namespace spall
{
using ShapeLibrary = std::vector<std::shared_ptr<const dem::Coefficients>>;

/// The random cloud of stones in its box, before compaction.
struct Specimen
{
  ShapeLibrary library;                ///< shared shapes, in order of file name
  std::unique_ptr<dem::Engine> engine; ///< stones and six planes
  dem::BoxPlanes box;
};

/// What the engine needs from the case, with the settings of preparation.
dem::EngineParameters engine_parameters(const Case &parameters);

/// Reads gradation and shapes, draws and places the stones. Throws InputError.
Specimen make_specimen(const Case &parameters);

/// The time step of the run [s]. Throws InputError if the fixed step is above
/// the critical one.
double choose_step(const Case &parameters, const dem::Engine &engine);

/// Gain of the exchange with the membrane as it will be, on the cube of the
/// nominal side. Throws InputError above the stable limit.
coupling::ExchangeGain check_gain(const Case &parameters,
                                  const dem::Engine &engine, double time_step);

/// Total volume of the stones [m^3].
double solid_volume(const dem::Particles &particles);
} // namespace spall
