#include "test/slices.h"

#include <dem/measure/outline.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace spall
{
namespace
{
/// Rows of one polygon.
struct PolygonRow
{
  double height = 0.;           ///< [-]
  std::int64_t particle = -1;   ///< -1: the space
  int is_spalled = 0, loop = 0; ///< [-]
};

void add_rows(const PolygonRow &row, const dem::Polygon &polygon,
              std::string &text)
{
  char line[120];
  for (const Eigen::Vector2d &corner : polygon)
  {
    std::snprintf(line, sizeof line, "%g,%lld,%d,%d,%.6g,%.6g\n", row.height,
                  static_cast<long long>(row.particle), row.is_spalled,
                  row.loop, corner.x(), corner.y());
    text += line;
  }
}

void add_polygons(PolygonRow row, std::span<const dem::Polygon> polygons,
                  std::string &text)
{
  for (const dem::Polygon &polygon : polygons)
  {
    add_rows(row, polygon, text);
    ++row.loop;
  }
}
} // namespace

std::vector<SpecimenSlice> cut_specimen(const dem::ParticleSystem &particles,
                                        std::span<const dem::FirstShape> first,
                                        const SliceSpace &space)
{
  std::vector<double> heights;
  for (const double share : slice_heights)
    heights.push_back(std::lerp(space.low, space.high, share));
  std::vector<dem::Slice> cut = dem::slices_at(particles, first, heights);
  std::vector<SpecimenSlice> slices;
  for (std::size_t k = 0; k < cut.size(); ++k)
    slices.push_back(
        {slice_heights[k], space.section(heights[k]), std::move(cut[k])});
  return slices;
}

dem::Polygon tube_section(const dem::FacetSurface &tube, double z)
{
  constexpr double half = 1e-6; // of a layer whose middle is cut [m]
  const dem::Outline outline = dem::outline_of(tube, z - half, z + half, 1);
  dem::Polygon polygon;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const dem::Outline::Side &side : outline.sections.front())
  {
    polygon.push_back(side[0]);
    middle += side[0];
  }
  middle /= std::max(1., static_cast<double>(polygon.size()));
  std::ranges::sort(
      polygon, {},
      [&](const Eigen::Vector2d &corner)
      { return std::atan2(corner.y() - middle.y(), corner.x() - middle.x()); });
  return polygon;
}

std::string slices_table(std::span<const SpecimenSlice> slices)
{
  std::string text = "height_share_1,particle_1,spalled_1,loop_1,x_m,y_m\n";
  for (const SpecimenSlice &slice : slices)
  {
    add_rows({slice.height}, slice.space, text);
    for (const dem::ParticleSection &one : slice.slice.particles)
    {
      add_polygons({slice.height, one.particle, 0, 0}, one.outline, text);
      add_polygons({slice.height, one.particle, 1, 0}, one.spalled, text);
    }
  }
  return text;
}

void add_slices(std::span<const SpecimenSlice> slices,
                nlohmann::ordered_json &summary)
{
  for (const SpecimenSlice &slice : slices)
  {
    double area = 0., lost = 0., depth = 0.;
    std::int64_t n_spalled = 0;
    for (const dem::ParticleSection &one : slice.slice.particles)
    {
      area += one.area;
      lost += one.lost_area;
      depth = std::max(depth, one.depth);
      n_spalled += one.spalled.empty() ? 0 : 1;
    }
    summary["slices"].push_back({{"height_share_1", slice.height},
                                 {"z_m", slice.slice.z},
                                 {"section_m2", dem::polygon_area(slice.space)},
                                 {"particle_area_m2", area},
                                 {"spalled_area_m2", lost},
                                 {"spalled_depth_m", depth},
                                 {"n_particles", slice.slice.particles.size()},
                                 {"n_spalled", n_spalled}});
  }
}
} // namespace spall
