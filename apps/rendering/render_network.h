#pragma once

#include "rendering/render.h"

namespace spall
{
/// Files of the contacts of one instant. An empty membrane: there is none.
struct NetworkFiles
{
  std::string title, contacts, membrane;
};

/// The contacts of a run folder where loading begins and, of its last frames,
/// where they bear most; none without frames.
std::vector<NetworkFiles> find_networks(const std::string &folder);

/// Normal force that 99 % of the contacts of these frames stay below [N].
double force_scale(std::span<const NetworkFiles> networks);

/// How far the membranes of these frames are outward of where they were put, in
/// horizontal direction from their axis, at most [m].
double bulge_scale(std::span<const NetworkFiles> networks);

/// Force chains: contacts as tubes as thick as their normal force, up to
/// `max_force` [N]; then, with a membrane, its bulge in the last frame up to
/// `max_bulge` [m]. Needs EGL, no display.
Picture render_network(std::span<const NetworkFiles> networks, double max_force,
                       double max_bulge);
} // namespace spall
