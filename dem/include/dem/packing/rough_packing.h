#pragma once

#include <dem/engine.h>
#include <dem/packing/insertion.h>
#include <dem/packing/pouring.h>

#include <functional>
#include <span>
#include <vector>

namespace dem
{
// Particles packed in seconds, to see what steps cost: what is measured in such
// a packing is worth nothing.

/// Positions at random in a room that is full up to a height [m], not free of
/// overlap: of a cloud of this solid fraction, or a thinner one if particles do
/// not find a free one, drawn together. Throws std::runtime_error if none does.
std::vector<Placement> dense_packing(std::span<const ParticleShape> particles,
                                     const Room &room, double height,
                                     double solid_fraction);

/// Overlaps of a random packing go until hardly any are left; steps are as long
/// as contacts allow and at most this long [s].
void relax(Engine &engine, double longest_step, int n_rounds = 60);

/// Scales the positions of particles, planes and drum about the origin.
void draw_together(Engine &engine, double factor);

/// The same in small pulls with some rounds of relax() after each, until
/// particles and walls press, or for forty seconds. Surfaces that lie deep in
/// each other do not see each other any more.
void draw_gently(Engine &engine, double factor, double longest_step,
                 const std::function<bool()> &is_pressing);

/// Steps like those of relax() until it is over, or for forty seconds: then
/// false; `steer` comes before each with its length [s].
bool run_roughly(Engine &engine, double longest_step,
                 const std::function<void(double)> &steer,
                 const std::function<bool()> &is_over);

/// A plane comes down from above the particles until they carry the load [N],
/// and stays there.
void press(Engine &engine, std::size_t plane, double load, double longest_step);
} // namespace dem
