#pragma once

#include "../simd_rows.h"
#include "force_kernels.h"

/// Particles of contacts in lanes. Internal to the units that are compiled once
/// per instruction set.
namespace dem::kernel
{
namespace
{
using ParticleSimd = SimdRows<particle_row>;

/// Simd that are contacts; the others only fill the set.
SimdMask valid_lanes(int n_valid)
{
  const Simd number([](auto lane) { return static_cast<double>(lane); });
  return number < static_cast<double>(n_valid);
}
} // namespace
} // namespace dem::kernel
