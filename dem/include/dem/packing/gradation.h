#pragma once

#include <dem/random.h>
#include <dem/shape/particle_shape.h>

#include <span>
#include <vector>

namespace dem
{
/// Grading curve by mass: share passing each sieve, straight in ln(d) between
/// the sieves. Diameters increase strictly; passing goes from 0 to 1 and may be
/// flat, where no particle has a size. The size of a particle is twice its mean
/// radius.
struct GradingCurve
{
  std::vector<double> diameter; ///< [m]
  std::vector<double> passing;  ///< [-]
};

/// Draws particles, largest first, of `solid_volume` [m^3] in all. Classes are
/// narrow and none extends over a sieve. A class is filled to half a particle;
/// the next finer class gets the rest, at a sieve no more than half a particle
/// of that size. The volume that passes a sieve is therefore the share of
/// `solid_volume` to one particle of that size. Each particle takes one of
/// `shapes` at random (spheres if empty). Throws std::invalid_argument for more
/// than ten million particles.
std::vector<ParticleShape>
draw_particles(const GradingCurve &curve, double solid_volume,
               std::span<const std::shared_ptr<const Coefficients>> shapes,
               Random &random);
} // namespace dem
