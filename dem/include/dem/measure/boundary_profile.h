#pragma once

#include <dem/measure/outline.h>

namespace dem
{
/// What the layers of a specimen at some distance from a boundary hold.
struct LayerProfile
{
  std::vector<double> distance; ///< of the middle of each layer [m]
  std::vector<double> porosity; ///< [-]; NaN: no space
  /// Contacts with particles of the particles in the layer that have two or
  /// more, as Eq. 31 counts; NaN: no such particle [-].
  std::vector<double> coordination;
  std::vector<double> n_particles; ///< with their centre in the layer [-]
};

struct BoundaryProfile
{
  LayerProfile lateral; ///< without the skin at the platens
  LayerProfile platens; ///< without the skin at the lateral boundary
  double porosity = 0.; ///< of all [-]
  /// Next to the lateral boundary and away from all boundaries [-].
  double porosity_skin = 0., porosity_inside = 0.;
  /// Of the particles with their centres there, as Eq. 31 counts; NaN: none
  /// [-].
  double coordination_skin = 0., coordination_inside = 0.;
};

struct ProfileWidths
{
  double layer = 0.; ///< about; a whole number of grid cells high [m]
  double skin = 0.;  ///< thickness of what counts as near a boundary [m]
};

/// Porosity and coordination number over the distance from the lateral
/// boundary, in horizontal section, and from the nearer platen. Porosity from
/// points in cells of a grid as fine as the sections are apart: a point is in a
/// particle, or in its image in a periodic cell, if it is within its radius
/// (overlaps count once). A face of the cell counts as a lateral boundary.
BoundaryProfile boundary_profile(const ParticleSystem &particles,
                                 const Network &network, const Outline &outline,
                                 const ProfileWidths &widths);
} // namespace dem
