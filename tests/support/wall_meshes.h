#pragma once

#include <dem/boundary/facet_surface.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

/// Walls of triangles for tests; nothing can move them.
namespace support
{
/// A surface with its topology.
struct WallMesh
{
  dem::FacetSurface surface;
  dem::FacetTopology topology;

  WallMesh() : topology(surface) {}
  explicit WallMesh(dem::FacetSurface of)
      : surface(std::move(of)), topology(surface)
  {
  }
  dem::FacetMesh view() const { return {surface, topology}; }
};

inline void complete(dem::FacetSurface &surface)
{
  const std::size_t n = surface.position.size();
  surface.velocity.assign(n, dem::Vec3::Zero());
  surface.mass.assign(n, std::numeric_limits<double>::infinity());
  surface.load.assign(n, dem::Vec3::Zero());
}

/// A floor about the origin of 2 n^2 triangles, particles above; vertices stand
/// `roughness` times the spacing up or down at most, and are moved aside by a
/// part of the spacing.
inline dem::FacetSurface flat_floor(double spacing, int n, double roughness,
                                    unsigned seed = 3)
{
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> some(-1., 1.);
  dem::FacetSurface surface;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j)
    {
      const double x = i - 0.5 * n + 0.2 * some(generator),
                   y = j - 0.5 * n + 0.2 * some(generator);
      surface.position.push_back(spacing *
                                 dem::Vec3(x, y, roughness * some(generator)));
    }
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
    {
      const std::int32_t a = i * (n + 1) + j, b = a + n + 1;
      surface.triangles.push_back({a, a + 1, b});
      surface.triangles.push_back({a + 1, b + 1, b});
    }
  complete(surface);
  return surface;
}

inline WallMesh flat_wall(double spacing, int n, double roughness)
{
  return WallMesh(flat_floor(spacing, n, roughness));
}

/// The inside of a cube from the origin to `size`.
inline dem::FacetSurface box_inside(double size)
{
  dem::FacetSurface surface;
  for (int corner = 0; corner < 8; ++corner)
    surface.position.push_back(
        size * dem::Vec3(corner & 1, corner >> 1 & 1, corner >> 2 & 1));
  // Counter-clockwise from outside.
  const std::array<std::array<std::int32_t, 4>, 6> faces = {{{0, 2, 3, 1},
                                                             {4, 5, 7, 6},
                                                             {0, 1, 5, 4},
                                                             {2, 6, 7, 3},
                                                             {0, 4, 6, 2},
                                                             {1, 3, 7, 5}}};
  for (const auto &f : faces)
  {
    surface.triangles.push_back({f[0], f[1], f[2]});
    surface.triangles.push_back({f[0], f[2], f[3]});
  }
  complete(surface);
  return surface;
}

inline WallMesh box_corner(double size)
{
  return WallMesh(box_inside(size));
}

/// A floor with blocks that stand out of it: every second square is up by 0.6
/// of the spacing, and joined to the others by steep sides.
inline WallMesh stepped_wall(double spacing, int n)
{
  // Two lines of vertices close together make a step.
  std::vector<double> line;
  for (int i = 0; i < n; ++i)
  {
    line.push_back(i - 0.5 * n + 0.1);
    line.push_back(i - 0.5 * n + 0.9);
  }
  const auto m = static_cast<std::int32_t>(line.size());
  dem::FacetSurface surface;
  for (std::int32_t i = 0; i < m; ++i)
    for (std::int32_t j = 0; j < m; ++j)
    {
      const bool is_up = i / 2 % 2 == 0 && j / 2 % 2 == 0;
      surface.position.push_back(spacing * dem::Vec3(line[std::size_t(i)],
                                                     line[std::size_t(j)],
                                                     is_up ? 0.6 : 0.));
    }
  for (std::int32_t i = 0; i + 1 < m; ++i)
    for (std::int32_t j = 0; j + 1 < m; ++j)
    {
      const std::int32_t a = i * m + j, b = a + m;
      surface.triangles.push_back({a, a + 1, b});
      surface.triangles.push_back({a + 1, b + 1, b});
    }
  complete(surface);
  return WallMesh(std::move(surface));
}

/// The inside of a cylinder about z of `n` sides, `length` long, vertices on
/// the radius.
inline dem::FacetSurface cylinder_inside(double radius, double length, int n,
                                         int n_rings)
{
  dem::FacetSurface surface;
  for (int ring = 0; ring <= n_rings; ++ring)
    for (int k = 0; k < n; ++k)
    {
      const double phi = 2. * std::numbers::pi * k / n;
      surface.position.emplace_back(radius * std::cos(phi),
                                    radius * std::sin(phi),
                                    length * (double(ring) / n_rings - 0.5));
    }
  for (std::int32_t ring = 0; ring < n_rings; ++ring)
    for (std::int32_t k = 0; k < n; ++k)
    {
      const std::int32_t a = ring * n + k, b = ring * n + (k + 1) % n;
      surface.triangles.push_back({a, b, b + n});
      surface.triangles.push_back({a, b + n, a + n});
    }
  complete(surface);
  return surface;
}
} // namespace support
