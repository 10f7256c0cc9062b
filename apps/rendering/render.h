#pragma once

#include "rendering/specimen_files.h"
#include "report/pictures.h"

#include <span>

namespace spall
{
/// The specimens side by side from one point of view, particles coloured by
/// loss from 0 to max_loss, with a colour bar. Needs EGL, no display.
Picture render_specimens(std::span<const SpecimenFiles> specimens,
                         double max_loss);
} // namespace spall
