#include "families.h"

#include <dem/measure/boundary_profile.h>
#include <dem/measure/hysteresis.h>
#include <dem/measure/region_stress.h>

#include <cmath>
#include <numbers>
#include <vector>

// Indicators of the contacts on lattices of equal spheres; a stress-strain
// loop. docs/theory/network.md.
namespace spall::verify
{
namespace
{
using dem::Vec3;

constexpr double pi = std::numbers::pi;
constexpr double radius = 0.01;       // m
constexpr double distance = 0.0199;   // of the centres [m]
constexpr double modulus = 5e8 / .75; // E* = G / (1 - nu) of two particles [Pa]

/// Elastic spheres, frictionless.
dem::Engine spheres(const std::vector<Vec3> &centres)
{
  dem::EngineParameters parameters;
  parameters.particle.friction = parameters.particle.rolling_friction = 0.;
  dem::Engine engine(parameters);
  for (const Vec3 &centre : centres)
    engine.add_particle(dem::make_sphere(radius), centre,
                        dem::Quaternion::Identity());
  engine.advance(1e-9);
  return engine;
}

/// n x n x n cells of the face-centred cubic lattice.
std::vector<Vec3> face_centred(int n)
{
  std::vector<Vec3> centres;
  for (int k = 0; k <= 2 * n; ++k)
    for (int j = 0; j <= 2 * n; ++j)
      for (int i = 0; i <= 2 * n; ++i)
        if ((i + j + k) % 2 == 0)
          centres.push_back(distance / std::numbers::sqrt2 * Vec3(i, j, k));
  return centres;
}

/// F of two spheres of one radius, R* = r / 2 (Hertz).
double hertz_force()
{
  return 4. / 3. * modulus * std::sqrt(0.5 * radius) *
         std::pow(2. * radius - distance, 1.5);
}

std::vector<Row> face_centred_packing()
{
  const dem::Engine engine = spheres(face_centred(4));
  const dem::Network network = dem::contact_network_of(engine);
  const double cell = std::numbers::sqrt2 * distance;
  const Vec3 lower = Vec3::Constant(1.3 * cell),
             side = Vec3::Constant(2. * cell);
  const dem::Mat3 stress = dem::mean_stress(dem::prism_of(lower, lower + side),
                                            engine.particles(), network);
  const double pressure =
      2. * std::numbers::sqrt2 * hertz_force() / (distance * distance);
  const dem::BoundaryProfile profile = dem::boundary_profile(
      engine.particles(), network,
      dem::outline_of(dem::prism_of(lower, lower + side), 100), {cell, 0.});
  // Four balls in a cell less the lenses of 24 contacts.
  const double cap = 0.5 * (2. * radius - distance),
               lens = 2. * pi / 3. * cap * cap * (3. * radius - cap);
  const double solid = (4. * 4. / 3. * pi * std::pow(radius, 3) - 24. * lens) /
                       std::pow(cell, 3);
  return {{"sigma_xx", "Pa", pressure, stress(0, 0), 1e-6},
          {"sigma_zz", "Pa", pressure, stress(2, 2), 1e-6},
          at_most("shear stress over pressure", "-",
                  std::abs(stress(0, 1)) / pressure, 1e-9),
          at_most("anisotropy of the fabric", "-",
                  dem::fabric_anisotropy(dem::fabric_tensor(network.pairs)),
                  1e-9),
          {"coordination number inside", "-", 12.,
           profile.lateral.coordination.front(), 1e-12},
          // Points a fiftieth of a cell apart.
          {"porosity", "-", 1. - solid, profile.porosity, 3e-3}};
}

/// Porosity between two distances from a plane that a layer of a simple cubic
/// packing rests on: 1 - int pi (r^2 - (z - r)^2) dz / (4 r^2 dz).
double layer_porosity(double from, double to)
{
  const auto solid = [](double z)
  { return pi * (radius * z * z - z * z * z / 3.); };
  return 1. - (solid(to) - solid(from)) / (4. * radius * radius * (to - from));
}

std::vector<Row> porosity_next_to_a_plane()
{
  constexpr int n = 4;
  dem::ParticleSystem particles;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        particles.add(dem::make_sphere(radius),
                      radius * Vec3(2 * i + 1, 2 * j + 1, 2 * k + 1),
                      dem::Quaternion::Identity(), 2700.);
  const double layer = 0.4 * radius;
  const dem::BoundaryProfile profile = dem::boundary_profile(
      particles, {},
      dem::outline_of(
          dem::prism_of(Vec3::Zero(), Vec3::Constant(2. * n * radius)), 160),
      {layer, 0.});
  std::vector<Row> rows;
  for (int k = 0; k < 3; ++k)
  {
    const auto layer_number = static_cast<std::size_t>(k);
    rows.push_back({"layer " + std::to_string(k + 1), "-",
                    layer_porosity(k * layer, (k + 1) * layer),
                    profile.platens.porosity[layer_number], 3e-3});
  }
  return rows;
}

std::vector<Row> fabric_of_a_cone()
{
  constexpr double angle = 0.5;
  std::vector<dem::PairContact> pairs(7);
  for (std::size_t k = 0; k < pairs.size(); ++k)
  {
    const double turn = 2. * pi * static_cast<double>(k) / 7.;
    pairs[k].normal = Vec3(std::sin(angle) * std::cos(turn),
                           std::sin(angle) * std::sin(turn), std::cos(angle));
  }
  const dem::Mat3 fabric = dem::fabric_tensor(pairs);
  const double axial = std::pow(std::cos(angle), 2);
  return {{"phi_zz", "-", axial, fabric(2, 2), 1e-12},
          {"anisotropy", "-", 3.75 * (3. * axial - 1.),
           dem::fabric_anisotropy(fabric), 1e-12}};
}

std::vector<Row> loop_of_a_lagging_strain()
{
  constexpr double lag = 0.2, stress = 50e3, strain = 1e-3;
  constexpr int n = 50;
  dem::Hysteresis loop;
  for (int k = 0; k <= n; ++k)
  {
    const double phase = 2. * pi * k / n;
    const double e = strain * (1. - std::cos(phase - lag)),
                 q = stress * (1. - std::cos(phase));
    if (k == 0)
      loop.begin(e, q);
    else
      loop.add(e, q);
  }
  // The polygon lacks (2 pi / n)^2 / 6 = 0.26 % of the area, and the largest
  // strain is between two points.
  return {
      {"damping ratio", "-", std::tan(0.5 * lag), loop.damping_ratio(), 5e-3},
      {"resilient modulus", "Pa", 2. * stress / (strain * (1. + std::cos(lag))),
       loop.resilient_modulus(), 5e-3}};
}
} // namespace

Family network()
{
  return {
      "network",
      "Indicators of the contacts, stress inside, boundary profiles, "
      "loops.",
      {{"face_centred_packing", "Hertz; lattice", face_centred_packing},
       {"porosity_next_to_a_plane", "sections of spheres",
        porosity_next_to_a_plane},
       {"fabric_of_a_cone", "phi_zz = cos^2; Kanatani 1984", fabric_of_a_cone},
       {"loop_of_a_lagging_strain", "linear viscous material",
        loop_of_a_lagging_strain}}};
}
} // namespace spall::verify
