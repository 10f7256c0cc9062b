#pragma once

#include "case.h"

#include <dem/contact/elliptic.h>
#include <dem/contact/laws/hertz.h>

namespace spall::verify
{
/// The particles of the article, and steel.
inline constexpr dem::Elasticity aggregate{.shear_modulus = 5e8,
                                           .poisson_ratio = 0.25};
inline constexpr dem::Elasticity steel{.shear_modulus = 7.9e10,
                                       .poisson_ratio = 0.28};
inline constexpr dem::Elasticity rigid{.is_rigid = true};

// laws_integrals.cc
std::vector<Row> pressure_integral();
std::vector<Row> traction_integral();
// laws_engine.cc
std::vector<Row> shape_contacts();
std::vector<Row> size_ratio();
std::vector<Row> springs();
} // namespace spall::verify
