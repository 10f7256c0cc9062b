#pragma once

#include <dem/shape/quadrature.h>

namespace dem::detail
{
/// |grad_S r| at every node of the rule, ring by ring [m].
std::vector<double> node_slopes(std::span<const double> coefficients,
                                const SphereQuadrature &rule);
} // namespace dem::detail
