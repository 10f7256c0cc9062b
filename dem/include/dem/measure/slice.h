#pragma once

#include <dem/particles/particle_system.h>
#include <dem/shape/polygon.h>

#include <cstdint>
#include <span>
#include <vector>

namespace dem
{
/// The shape that a particle has before it breaks.
struct FirstShape
{
  std::shared_ptr<const Coefficients> series; ///< null: a sphere
  double scale = 1.; ///< of the series, as in ParticleShape
  double reach = 0.; ///< r is nowhere larger [m]
};

/// Of particles that have not broken yet, by their ids 0, 1, ...
std::vector<FirstShape> first_shapes(const ParticleSystem &particles);

/// Where a horizontal plane cuts one particle.
struct ParticleSection
{
  std::int64_t particle = 0;    ///< global id
  std::vector<Polygon> outline; ///< of the particle as it is [m]
  std::vector<Polygon> spalled; ///< lost since its first shape [m]
  double area = 0.;             ///< of the particle as it is [m^2]
  /// Area of its first shape in its present position, less that [m^2].
  double lost_area = 0.;
  double depth = 0.; ///< largest radius that it has lost at the outline [m]
};

/// Where a horizontal plane cuts a specimen.
struct Slice
{
  double z = 0.;                          ///< [m]
  std::vector<ParticleSection> particles; ///< in the order of their ids
};

/// How far outlines and regions are simplified.
struct SliceParameters
{
  /// Distance of a polygon from what it stands for, over the radius of the
  /// equivalent sphere [-].
  double tolerance = 2e-3;
  /// A region is spalled where the radius has dropped by more than this share
  /// of that of the equivalent sphere [-].
  double least_depth = 1e-4;
};

/// Horizontal slices at these heights [m]. Areas are those before polygons are
/// simplified. Particles of a periodic cell are cut where they are.
std::vector<Slice> slices_at(const ParticleSystem &particles,
                             std::span<const FirstShape> first,
                             std::span<const double> heights,
                             const SliceParameters &parameters = {});
} // namespace dem
