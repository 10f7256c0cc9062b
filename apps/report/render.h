#pragma once

#include "report/specimen_files.h"

#include <span>
#include <string>

namespace spall
{
struct Picture
{
  std::string png;     ///< the file as bytes; empty: not drawn
  std::string problem; ///< why, one sentence
  int width = 0;       ///< [px]
};

/// The specimens side by side from one point of view, particles coloured by
/// loss from 0 to max_loss, with a colour bar. Needs EGL, no display.
Picture render_specimens(std::span<const SpecimenFiles> specimens,
                         double max_loss);
} // namespace spall
