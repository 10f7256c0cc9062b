#pragma once

#include <dem/shape/mesh_curvature.h>

#include <string>

namespace spall
{
/// Views of a mesh (left) and of its series (right) from (1, 1, 0.8): above
/// kappa_max times the inscribed radius, below corners and edges. An SVG
/// element.
std::string corner_picture(const dem::CornerComparison &compared);
} // namespace spall
