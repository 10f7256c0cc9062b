#pragma once

#include <dem/measure/network.h>

#include <cmath>
#include <numbers>
#include <vector>

/// Regular packings of equal spheres with given contact forces.
namespace packings
{
inline constexpr double radius = 0.01; ///< [m]

/// Spheres at these positions; every pair that is a diameter apart touches.
struct Packing
{
  dem::ParticleSystem particles;
  dem::Network network;
};

/// `force(normal)`: size of the normal force of such a contact [N].
template <class Force>
Packing touching(const std::vector<dem::Vec3> &centres, const Force &force)
{
  Packing packing;
  for (const dem::Vec3 &centre : centres)
    packing.particles.add(dem::make_sphere(radius), centre,
                          dem::Quaternion::Identity(), 2700.);
  for (std::size_t i = 0; i < centres.size(); ++i)
    for (std::size_t j = i + 1; j < centres.size(); ++j)
    {
      const dem::Vec3 branch = centres[j] - centres[i];
      if (branch.norm() > 2. * radius * (1. + 1e-9))
        continue;
      dem::PairContact contact;
      contact.a = static_cast<std::int32_t>(i);
      contact.b = static_cast<std::int32_t>(j);
      contact.normal = branch.normalized();
      contact.point = 0.5 * (centres[i] + centres[j]);
      contact.force = -force(contact.normal) * contact.normal;
      packing.network.pairs.push_back(contact);
    }
  return packing;
}

/// n x n x n spheres in a cube of side 2 n radius from the origin.
inline std::vector<dem::Vec3> simple_cubic(int n)
{
  std::vector<dem::Vec3> centres;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        centres.push_back(radius * dem::Vec3(2 * i + 1, 2 * j + 1, 2 * k + 1));
  return centres;
}

inline const double fcc_cell = 2. * std::numbers::sqrt2 * radius; ///< [m]

/// n x n x n cells of the face-centred cubic lattice, from the origin.
inline std::vector<dem::Vec3> face_centred(int n)
{
  std::vector<dem::Vec3> centres;
  for (int k = 0; k <= 2 * n; ++k)
    for (int j = 0; j <= 2 * n; ++j)
      for (int i = 0; i <= 2 * n; ++i)
        if ((i + j + k) % 2 == 0)
          centres.push_back(0.5 * fcc_cell * dem::Vec3(i, j, k));
  return centres;
}
} // namespace packings
