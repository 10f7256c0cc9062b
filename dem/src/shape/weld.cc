#include <dem/shape/fit.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <unordered_map>

namespace dem
{
namespace
{
using Index = std::size_t;

auto key(const Vec3 &p)
{
  return std::make_tuple(p.x(), p.y(), p.z());
}

/// Points that stand for all within a tolerance of them, in a grid of cells.
class NearPoints
{
public:
  /// Cells are counted from `from`: far from zero no digit is lost.
  NearPoints(double within, const Vec3 &from)
      : tolerance(within), inverse_cell(1. / (8. * within)), origin(from)
  {
  }

  /// Number of the point that stands for this one, -1 if there is none.
  std::int32_t find(const Vec3 &p) const
  {
    const Cell low = cell_of(p - Vec3::Constant(tolerance)),
               high = cell_of(p + Vec3::Constant(tolerance));
    for (std::int64_t x = low.x; x <= high.x; ++x)
      for (std::int64_t y = low.y; y <= high.y; ++y)
        for (std::int64_t z = low.z; z <= high.z; ++z)
        {
          const auto [begin, end] = grid.equal_range(hash({x, y, z}));
          for (auto entry = begin; entry != end; ++entry)
            if ((entry->second.position - p).norm() <= tolerance)
              return entry->second.number;
        }
    return -1;
  }

  void add(const Vec3 &p, std::int32_t number)
  {
    grid.emplace(hash(cell_of(p)), Entry{p, number});
  }

private:
  struct Cell
  {
    std::int64_t x = 0, y = 0, z = 0;
  };
  struct Entry
  {
    Vec3 position; ///< [m]
    std::int32_t number = 0;
  };

  Cell cell_of(const Vec3 &p) const
  {
    const Vec3 cell = inverse_cell * (p - origin);
    return {std::int64_t(std::floor(cell.x())),
            std::int64_t(std::floor(cell.y())),
            std::int64_t(std::floor(cell.z()))};
  }

  static std::uint64_t hash(const Cell &cell)
  {
    std::uint64_t value = 0;
    for (const std::int64_t part : {cell.x, cell.y, cell.z})
      value = (value ^ std::uint64_t(part)) * 0x9e3779b97f4a7c15u;
    return value ^ value >> 32;
  }

  const double tolerance, inverse_cell; ///< [m], [1/m]
  const Vec3 origin;
  std::unordered_multimap<std::uint64_t, Entry> grid;
};

/// For each point of a mesh the number of the one that stands for it; these
/// are put into `kept`, in the order of their coordinates.
std::vector<std::int32_t> merge(const std::vector<Vec3> &points,
                                double tolerance, std::vector<Vec3> &kept)
{
  std::vector<std::int32_t> order(points.size()), number(points.size());
  std::iota(order.begin(), order.end(), 0);
  const auto at = [&](Index i) -> const Vec3 &
  { return points[Index(order[i])]; };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::int32_t a, std::int32_t b)
                   { return key(points[Index(a)]) < key(points[Index(b)]); });
  NearPoints near(tolerance, points.empty() ? Vec3::Zero().eval() : at(0));
  for (Index i = 0; i < order.size(); ++i)
  {
    std::int32_t &mine = number[Index(order[i])];
    if (i > 0 && key(at(i)) == key(at(i - 1)))
    {
      mine = number[Index(order[i - 1])];
      continue;
    }
    mine = tolerance > 0. ? near.find(at(i)) : -1;
    if (mine >= 0)
      continue;
    mine = std::int32_t(kept.size());
    kept.push_back(at(i));
    if (tolerance > 0.)
      near.add(at(i), mine);
  }
  return number;
}
} // namespace

TriangleMesh weld(const TriangleMesh &mesh, double tolerance)
{
  // Beyond these there is nothing to weld, and cells could not be counted.
  const bool is_sound = tolerance > 1e-100 && tolerance < 1e100;
  TriangleMesh welded;
  const std::vector<std::int32_t> number =
      merge(mesh.points, is_sound ? tolerance : 0., welded.points);
  for (const auto &t : mesh.triangles)
  {
    const std::array<std::int32_t, 3> w = {
        number[Index(t[0])], number[Index(t[1])], number[Index(t[2])]};
    if (w[0] != w[1] && w[1] != w[2] && w[2] != w[0])
      welded.triangles.push_back(w);
  }
  return welded;
}
} // namespace dem
