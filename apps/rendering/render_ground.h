#pragma once

#include "rendering/render.h"

namespace spall
{
/// Files of the subgrade at one instant, given in the title [s since the
/// first frame], and where it began. An empty plate: there is none.
struct GroundFiles
{
  std::string title, start, ground, plate;
};

/// The subgrade of a run folder, of its frames the one in which it has settled
/// most and the last; none with less than two frames.
std::vector<GroundFiles> find_grounds(const std::string &folder);

/// How far a node of the subgrade has settled at most since its first frame, in
/// these frames [m].
double settlement_scale(std::span<const GroundFiles> grounds);

/// The subgrade behind the section through its middle, coloured by its
/// settlement since the first frame up to `max_settlement` [m] and bent by many
/// times that. Needs EGL, no display.
Picture render_ground(std::span<const GroundFiles> grounds,
                      double max_settlement);
} // namespace spall
