#pragma once

#include <span>
#include <string>
#include <vector>

namespace spall
{
/// Files of one instant. An empty membrane: there is none.
struct SpecimenFiles
{
  std::string title, surfaces, membrane;
};

/// First and last frame with surfaces of a run folder; none, one or two.
std::vector<SpecimenFiles> find_specimens(const std::string &folder);

/// Upper end of the colour bar: the loss that 98 % of the stones stay below,
/// rounded up, in the last of these frames [-].
double loss_scale(std::span<const SpecimenFiles> specimens);

struct Picture
{
  std::string png;     ///< the file as bytes; empty: not drawn
  std::string problem; ///< why, one sentence
};

/// The specimens side by side from one point of view, stones coloured by loss
/// from 0 to max_loss, with a colour bar. Needs EGL, no display.
Picture render_specimens(std::span<const SpecimenFiles> specimens,
                         double max_loss);
} // namespace spall
