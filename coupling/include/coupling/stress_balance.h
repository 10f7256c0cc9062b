#pragma once

#include <coupling/enclosed_specimen.h>

namespace coupling
{
/// Mean stresses of a specimen over the volume that its membrane or its rigid
/// sides enclose, [force direction][position], compression positive [Pa]:
///   particles + membrane = boundary + unrest
/// at any instant, to the digits of the dashpots (docs/theory/stress.md); in a
/// periodic cell the diagonals alone, since the shear across its faces is not
/// summed.
struct StressBalance
{
  dem::Mat3 particles =
      dem::Mat3::Zero();                  ///< contacts of the particles, virial
  dem::Mat3 membrane = dem::Mat3::Zero(); ///< of the sheet itself
  dem::Mat3 boundary =
      dem::Mat3::Zero(); ///< pressure, plates, sides, rims, faces
  dem::Mat3 unrest = dem::Mat3::Zero(); ///< forces that accelerate masses
};

/// Of a tensor: along the axis, and the mean across.
inline double axial(const dem::Mat3 &stress)
{
  return stress(2, 2);
}
inline double lateral(const dem::Mat3 &stress)
{
  return 0.5 * (stress(0, 0) + stress(1, 1));
}

/// What presses on membrane and plate from outside.
struct ConfiningLoad
{
  double pressure = 0.;     ///< on the membrane [Pa]
  double plate_area = 0.;   ///< [m^2]
  double plate_height = 0.; ///< of its lower face above the base [m]
  dem::Vec3 origin = dem::Vec3::Zero(); ///< middle of the base [m]
};

/// Of the sheet, compression positive; zero without one [Pa].
dem::Mat3 membrane_stress(const EnclosedSpecimen &specimen);

/// What bears the load of the boundary.
StressBalance stress_balance(const EnclosedSpecimen &specimen,
                             const ConfiningLoad &load);
} // namespace coupling
