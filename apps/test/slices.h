#pragma once

#include "test/slice_space.h"

#include <dem/boundary/facet_surface.h>
#include <dem/measure/slice.h>

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <span>
#include <string>
#include <vector>

namespace spall
{
/// Heights of the slices of a specimen over its height [-].
inline constexpr std::array slice_heights = {0.25, 0.5, 0.75};

/// One slice with the section of the space that it lies in.
struct SpecimenSlice
{
  double height = 0.; ///< over that of the specimen [-]
  dem::Polygon space; ///< [m]
  dem::Slice slice;
};

/// Slices at slice_heights. `first` are the shapes of unbroken particles by id.
std::vector<SpecimenSlice> cut_specimen(const dem::ParticleSystem &particles,
                                        std::span<const dem::FirstShape> first,
                                        const SliceSpace &space);

/// Section of a tube of triangles whose sections are star-shaped about their
/// middle.
dem::Polygon tube_section(const dem::FacetSurface &tube, double z);

/// Corners of all polygons, as the text of a CSV file. Particle -1 is the
/// space; spalled_1 is 1 for what a particle has lost.
std::string slices_table(std::span<const SpecimenSlice> slices);

/// Adds the entry `slices`: areas and counts of each.
void add_slices(std::span<const SpecimenSlice> slices,
                nlohmann::ordered_json &summary);
} // namespace spall
