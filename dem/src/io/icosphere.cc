#include "icosphere.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace dem
{
namespace
{
Icosphere icosahedron()
{
  const double g = (1. + std::sqrt(5.)) / 2.; // golden ratio
  Icosphere sphere;
  sphere.directions = {{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0},
                       {0, -1, g}, {0, 1, g}, {0, -1, -g}, {0, 1, -g},
                       {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
  sphere.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10},
                      {0, 10, 11}, {1, 5, 9},  {5, 11, 4}, {11, 10, 2},
                      {10, 7, 6},  {7, 1, 8},  {3, 9, 4},  {3, 4, 2},
                      {3, 2, 6},   {3, 6, 8},  {3, 8, 9},  {4, 9, 5},
                      {2, 4, 11},  {6, 2, 10}, {8, 6, 7},  {9, 8, 1}};
  for (Vec3 &direction : sphere.directions)
    direction.normalize();
  return sphere;
}

Icosphere divide(const Icosphere &coarse)
{
  Icosphere fine;
  fine.directions = coarse.directions;
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
  const auto middle = [&](std::int32_t a, std::int32_t b)
  {
    const auto next = static_cast<std::int32_t>(fine.directions.size());
    const auto [entry, is_new] = middles.try_emplace(std::minmax(a, b), next);
    if (is_new)
      fine.directions.push_back(
          (coarse.directions[a] + coarse.directions[b]).normalized());
    return entry->second;
  };
  for (const auto &[a, b, c] : coarse.triangles)
  {
    const std::int32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const auto &part :
         {std::array{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}})
      fine.triangles.push_back(part);
  }
  return fine;
}
} // namespace

Icosphere make_icosphere(int n_divisions)
{
  Icosphere sphere = icosahedron();
  for (int k = 0; k < n_divisions; ++k)
    sphere = divide(sphere);
  return sphere;
}
} // namespace dem
