#include "flat_mesh.h"
#include "relax.h"

#include <gtest/gtest.h>

#include <cmath>

// A membrane some of whose quads are halved: nodes in the middle of the edges
// of larger quads move with their ends.
namespace
{
using Vector = Eigen::Vector3d;

/// n x n quads, those halved whose centre is in the middle third.
fem::SurfaceMesh halved_square(double side, int n)
{
  const fem::SurfaceMesh mesh = support::flat_square(side, n);
  std::vector<std::int32_t> middle;
  for (std::int32_t k = 0; k < n * n; ++k)
  {
    const double x = (k % n + 0.5) / n - 0.5, y = (k / n + 0.5) / n - 0.5;
    if (std::max(std::abs(x), std::abs(y)) < 1. / 6.)
      middle.push_back(k);
  }
  return fem::halve_quads(mesh, middle);
}

void tie_rim(fem::Membrane &membrane, double side)
{
  std::vector<std::int32_t> rim;
  for (std::size_t k = 0; k < membrane.n_nodes(); ++k)
  {
    const Vector &x = membrane.mesh().nodes[k];
    if (std::min({x.x(), x.y(), side - x.x(), side - x.y()}) < 1e-9)
      rim.push_back(static_cast<std::int32_t>(k));
  }
  membrane.tie(rim);
}

double balance(const fem::MembraneEnergy &e)
{
  return e.strain + e.kinetic - e.pressure_work - e.contact_work + e.damping -
         e.tie_work;
}

std::size_t node_at(const fem::Membrane &membrane, double x, double y)
{
  for (std::size_t k = 0; k < membrane.n_nodes(); ++k)
    if ((membrane.mesh().nodes[k] - Vector(x, y, 0.)).norm() < 1e-9)
      return k;
  throw std::logic_error("no node there");
}

// A homogeneous strain is in the space of the elements, so nothing moves; its
// energy is that of the law.
TEST(HalvedMembrane, BearsAHomogeneousStrain)
{
  fem::MembraneParameters p;
  fem::Membrane membrane(p, halved_square(0.3, 6));
  ASSERT_EQ(membrane.mesh().midpoints.size(), 8u);
  tie_rim(membrane, 0.3);
  Eigen::Matrix3d stretch;
  stretch << 1.2, 0.1, 0., 0., 0.95, 0., 0.05, 0., 1.;
  std::vector<Vector> x = membrane.mesh().nodes;
  for (Vector &node : x)
    node = stretch * node;
  membrane.set_positions(x);
  EXPECT_LT(membrane.unbalanced_force_ratio(), 1e-12);
  const Eigen::Matrix2d e =
      0.5 * ((stretch.transpose() * stretch).topLeftCorner<2, 2>() -
             Eigen::Matrix2d::Identity());
  const double c =
      p.youngs_modulus * p.thickness / (1. - p.poisson_ratio * p.poisson_ratio);
  const double density = 0.5 * c *
                         ((1. - p.poisson_ratio) * (e * e).trace() +
                          p.poisson_ratio * e.trace() * e.trace());
  EXPECT_NEAR(membrane.energy().strain, density * 0.09, 1e-12 * density);
}

// T lap w = -p on a square of side a: w0 = 0.0736713532815 p a^2 / T (series).
// Halving the middle brings the deflection there nearer.
TEST(HalvedMembrane, SagsAsItsTensionSays)
{
  fem::MembraneParameters p;
  p.youngs_modulus = 1e3; // no stiffness but of the tension
  p.tension = 500.;
  const double side = 0.3, pressure = 0.5;
  const double exact = 0.0736713532815 * pressure * side * side / p.tension;
  const auto error_of = [&](const fem::SurfaceMesh &mesh)
  {
    fem::Membrane membrane(p, mesh);
    tie_rim(membrane, side);
    membrane.set_pressure(-pressure);
    const support::Loads none(membrane.n_nodes(), Vector::Zero());
    for (double dt = 1e-3; dt < 2e3; dt *= 10.)
      for (int k = 0; k < 4; ++k)
        membrane.advance(none, dt, fem::generalised_alpha(0.));
    EXPECT_LT(membrane.unbalanced_force_ratio(), 1e-7);
    const auto at = node_at(membrane, 0.5 * side, 0.5 * side);
    return membrane.positions()[at].z() / exact - 1.;
  };
  const double coarse = error_of(support::flat_square(side, 12)),
               halved = error_of(halved_square(side, 12)),
               fine = error_of(support::flat_square(side, 24));
  std::printf("deflection off by %.2e, middle halved %.2e, all %.2e\n", coarse,
              halved, fine);
  EXPECT_NEAR(coarse / fine, 4., 0.4);
  EXPECT_LT(std::abs(halved), std::abs(coarse));
  EXPECT_LT(std::abs(halved), 3e-3);
}

/// Energies over what passed, of a square that swings under loads.
struct Swing
{
  explicit Swing(const fem::SurfaceMesh &mesh) : membrane(parameters(), mesh)
  {
    tie_rim(membrane, 0.3);
    std::vector<Vector> x = membrane.mesh().nodes;
    for (Vector &node : x)
      node *= 1.1;
    membrane.set_positions(x);
    membrane.set_pressure(200.);
  }
  static fem::MembraneParameters parameters()
  {
    fem::MembraneParameters p;
    p.mass_damping = 5.;
    return p;
  }
  /// Loads on all nodes, those in the middle of edges too.
  void run(double duration, int n_steps, bool is_explicit)
  {
    const double dt = duration / n_steps, start = balance(membrane.energy());
    const support::Loads loads(membrane.n_nodes(), Vector(1e-3, 0., 0.01));
    for (int k = 0; k < n_steps; ++k)
      if (is_explicit)
      {
        membrane.begin_step(dt);
        membrane.end_step(loads, dt);
      }
      else
        membrane.advance(loads, dt);
    const fem::MembraneEnergy e = membrane.energy();
    error = std::abs(balance(e) - start) / std::abs(e.pressure_work);
    for (const fem::SurfaceMesh::Midpoint &middle : membrane.mesh().midpoints)
    {
      const auto far = [&](std::span<const Vector> field)
      {
        return (field[std::size_t(middle.node)] -
                0.5 * (field[std::size_t(middle.ends[0])] +
                       field[std::size_t(middle.ends[1])]))
            .norm();
      };
      energy_error = std::max({energy_error, far(membrane.positions()),
                               1e-3 * far(membrane.velocities())});
    }
  }
  fem::Membrane membrane;
  double error = 0., energy_error = 0.;
};

TEST(HalvedMembrane, KeepsItsEnergyAndItsEdges)
{
  const fem::SurfaceMesh mesh = halved_square(0.3, 6);
  Swing reference(mesh), coarse(mesh), fine(mesh);
  reference.run(0.02, 8000, true);
  coarse.run(0.02, 80, false);
  fine.run(0.02, 160, false);
  const std::size_t at = node_at(reference.membrane, 0.15, 0.15);
  const auto z = [&](const Swing &swing)
  { return swing.membrane.positions()[at].z(); };
  const double coarse_error = z(coarse) - z(reference),
               fine_error = z(fine) - z(reference);
  std::printf("errors %.2e %.2e of %.2e; balance %.1e, %.1e, %.1e\n",
              coarse_error, fine_error, z(reference), reference.error,
              coarse.error, fine.error);
  EXPECT_NEAR(coarse.error / fine.error, 4., 0.8);
  EXPECT_LT(std::abs(coarse_error), 3e-3 * std::abs(z(reference)));
  EXPECT_LT(std::abs(fine_error), 3e-3 * std::abs(z(reference)));
  EXPECT_LT(reference.error, 1e-5);
  EXPECT_LT(fine.error, 1e-3);
  for (const Swing *swing : {&reference, &coarse, &fine})
    EXPECT_LT(swing->energy_error, 1e-15);
}

/// Largest kinetic energy after a kick.
double largest_kinetic(double share_of_stable_step)
{
  fem::Membrane membrane({}, halved_square(0.3, 6));
  tie_rim(membrane, 0.3);
  std::vector<Vector> stretched = membrane.mesh().nodes;
  for (Vector &x : stretched)
    x *= 1.2;
  membrane.set_positions(stretched);
  const double dt = share_of_stable_step * membrane.stable_time_step();
  auto loads = support::random_vectors(membrane.n_nodes(), 1e-6, 9);
  double largest = 0.;
  for (int step = 0; step < 600 && largest < 1e-3; ++step)
  {
    membrane.begin_step(dt);
    membrane.end_step(loads, dt);
    std::fill(loads.begin(), loads.end(), Vector::Zero());
    largest = std::max(largest, membrane.energy().kinetic);
  }
  return largest;
}

TEST(HalvedMembrane, IsStableUpToItsStep)
{
  EXPECT_LT(largest_kinetic(0.98), 1e-8);
  EXPECT_GT(largest_kinetic(1.02), 1e-3);
}
} // namespace
