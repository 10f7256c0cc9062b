#pragma once

#include <dem/boundary/facet_surface.h>

#include <array>
#include <cstdint>
#include <vector>

namespace dem
{
/// Triangles of a surface filed under the cells of a grid that their boxes
/// touch; cells are about as large as triangles.
class TriangleBins
{
public:
  explicit TriangleBins(const FacetSurface &surface);

  /// Triangles whose boxes come within `reach` of x, each once, in order.
  void gather(const Vec3 &x, double reach,
              std::vector<std::int32_t> &found) const;

private:
  using Cell = std::array<std::int32_t, 3>;

  void choose_cells(const FacetSurface &surface);
  void file_triangles();
  Cell cell_of(const Vec3 &x) const;
  Vec3 gap_of_box(std::int32_t triangle, const Vec3 &x) const;
  /// Calls visit(cell, end) for the cells of each row along x between corners.
  template <class Visit>
  void for_rows(const Vec3 &lower, const Vec3 &upper, const Visit &visit) const;

  std::vector<Vec3> centre, half_width; ///< of the boxes of triangles [m]
  Vec3 origin = Vec3::Zero();           ///< lowest corner of the grid [m]
  double size = 1.;                     ///< side of a cell [m]
  Cell n{1, 1, 1};                      ///< cells along the axes
  /// Triangles of each cell, in rows.
  std::vector<std::int32_t> row_start, triangle;
};
} // namespace dem
