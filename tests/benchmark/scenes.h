#pragma once

#include <dem/engine.h>

#include <memory>

/// What the kernels are timed on.
namespace benchmark_scenes
{
enum class ParticleSystem
{
  spheres,
  shapes ///< a rounded cube, the same for all
};

/// Steps this short move nothing: random shapes on a lattice overlap far too
/// much to be let go [s].
inline constexpr double frozen_step = 1e-12;

/// Body-centred lattice of about `n` touching particles, 10 mm wide, in a box
/// of its own; advanced by a few frozen steps.
std::unique_ptr<dem::Engine> lattice(int n, ParticleSystem kind,
                                     const dem::BreakageParameters &breakage = {
                                         .is_active = false});

/// A cube with rounded edges, series of order 20, ball radius `radius` [m].
dem::ParticleShape rounded_cube(double radius);

/// Directions spread evenly over the sphere (Fibonacci lattice).
std::vector<dem::Vec3> directions(int n);
} // namespace benchmark_scenes
