#pragma once

#include <dem/control/box_servo.h>
#include <dem/measure/boundary_profile.h>
#include <fem/membrane.h>

#include <vector>

namespace coupling
{
/// Particles between rigid walls, or between platens and a membrane.
struct EnclosedSpecimen
{
  const dem::Engine &engine;
  const dem::SpecimenWalls &walls;
  const fem::Membrane *membrane = nullptr; ///< null: rigid sides
};

/// Volume inside the membrane or the rigid walls [m^3].
double enclosed_volume(const EnclosedSpecimen &specimen);

/// The space between the rigid walls, or where the membrane was put, between
/// base and plate now.
dem::Prism space_of(const EnclosedSpecimen &specimen);

/// Thickness of what counts as near a boundary: the largest particle, at most a
/// quarter of the least width of the space [m].
double skin_of(const EnclosedSpecimen &specimen);

/// Porosity and coordination number over the distance from the boundaries.
dem::BoundaryProfile boundary_profile(const EnclosedSpecimen &specimen);

/// Areas of horizontal sections at equal distances from base to plate [m^2].
std::vector<double> section_areas(const EnclosedSpecimen &specimen);
} // namespace coupling
