#pragma once

#include "specimen/gradation.h"
#include "specimen/specimen.h"

#include <dem/random.h>

#include <optional>
#include <string>
#include <vector>

namespace spall
{
/// Draws particles of this volume [m^3] by the gradation of a case, largest
/// first. Throws InputError.
std::vector<dem::ParticleShape> draw_particles(const Case &parameters,
                                               double solid_volume,
                                               const ShapeLibrary &shapes,
                                               dem::Random &random);

/// Gradation of the particles as drawn beside that of the table, at its sieves
/// and between them.
struct ObtainedGradation
{
  std::vector<double> diameter; ///< rising [m]
  std::vector<double> asked;    ///< share of the mass that passes [-]
  std::vector<double> obtained; ///< the same of the particles [-]
  /// Mass of a sphere of this diameter over the mass of all particles [-]
  std::vector<double> one_particle;

  double largest_difference() const; ///< of obtained and required [-]
};

/// Of the particles of a case before any has broken. Their size is twice the
/// mean radius. Empty for a kind without gradation.
std::optional<ObtainedGradation>
obtained_gradation(const Case &parameters, const dem::ParticleSystem &as_drawn);

inline constexpr const char *gradation_file = "gradation.csv";

/// Text of gradation.csv.
std::string gradation_table(const ObtainedGradation &gradation);

/// For the log: range of sizes and the largest difference from the table; a
/// warning where the difference is large or sizes look like mm.
std::string gradation_line(const ObtainedGradation &gradation);
} // namespace spall
