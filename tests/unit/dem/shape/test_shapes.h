#pragma once

#include <dem/shape/fit.h>
#include <dem/shape/quadrature.h>
#include <dem/shape/spherical_harmonics.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

/// Shapes and small numerics for the tests of shape and breakage.
namespace dem::test
{
inline std::vector<Vec3> random_directions(int n, unsigned seed)
{
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  std::vector<Vec3> directions;
  for (int i = 0; i < n; ++i)
    directions.push_back(
        Vec3(normal(generator), normal(generator), normal(generator))
            .normalized());
  return directions;
}

/// Mean radius 0.01 m, decaying as a particle does.
inline std::vector<double> random_particle(int order, unsigned seed)
{
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  std::vector<double> a(std::size_t(n_coefficients(order)), 0.);
  for (std::size_t j = 1; j < a.size(); ++j)
    a[j] = 2e-3 * normal(generator) / double(j + 1);
  a[0] = 0.01 * std::sqrt(4. * std::numbers::pi);
  return a;
}

/// Least squares on the 40 x 80 rule.
inline std::vector<double> project(int order,
                                   const std::function<double(Vec3)> &r)
{
  const SphereQuadrature &rule = standard_quadrature();
  std::vector<double> a(std::size_t(n_coefficients(order)), 0.), y(a.size());
  for (std::size_t k = 0; k < rule.direction.size(); ++k)
  {
    evaluate_harmonics(order, rule.direction[k], y);
    const double value = rule.weight[k] * r(rule.direction[k]);
    for (std::size_t j = 0; j < y.size(); ++j)
      a[j] += value * y[j];
  }
  return a;
}

inline double ellipsoid_radius(const Vec3 &axes, const Vec3 &s)
{
  return 1. / s.cwiseQuotient(axes).norm();
}

inline std::vector<double> sphere_series(int order, double radius)
{
  std::vector<double> a(std::size_t(n_coefficients(order)), 0.);
  a[0] = radius * std::sqrt(4. * std::numbers::pi);
  return a;
}

/// Two unit tangents at s.
struct Tangents
{
  Vec3 first, second;
};

inline Tangents tangents(const Vec3 &s)
{
  const Vec3 first = s.unitOrthogonal();
  return {first, s.cross(first)};
}

/// A sphere of latitudes and longitudes whose points are moved to r(s).
inline TriangleMesh radial_mesh(int n_polar,
                                const std::function<double(Vec3)> &r)
{
  TriangleMesh mesh;
  const int n_azimuth = 2 * n_polar;
  const auto add = [&](double polar, double azimuth)
  {
    const Vec3 s(std::sin(polar) * std::cos(azimuth),
                 std::sin(polar) * std::sin(azimuth), std::cos(polar));
    mesh.points.push_back(r(s) * s);
  };
  add(0., 0.);
  for (int i = 1; i < n_polar; ++i)
    for (int k = 0; k < n_azimuth; ++k)
      add(std::numbers::pi * i / n_polar,
          2. * std::numbers::pi * k / n_azimuth);
  add(std::numbers::pi, 0.);
  const int last = int(mesh.points.size()) - 1;
  for (int i = 0; i < n_polar; ++i)
    for (int k = 0; k < n_azimuth; ++k)
    {
      const int next = (k + 1) % n_azimuth;
      const auto at = [&](int ring, int azimuth)
      {
        return ring == 0         ? 0
               : ring == n_polar ? last
                                 : 1 + (ring - 1) * n_azimuth + azimuth;
      };
      if (i < n_polar - 1)
        mesh.triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, next)});
      if (i > 0)
        mesh.triangles.push_back({at(i, k), at(i + 1, next), at(i, next)});
    }
  return mesh;
}
} // namespace dem::test
