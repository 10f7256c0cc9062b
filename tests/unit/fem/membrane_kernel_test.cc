#include "enclosed_volume.h"
#include "flat_mesh.h"
#include "membrane_kernel.h"
#include "membrane_space.h"
#include "stable_step.h"

#include <gtest/gtest.h>

namespace
{
using Vector = Eigen::Vector3d;
using Field = std::vector<Vector>;

constexpr double modulus = 1.4e6, poisson = 0.45, thickness = 1e-3;

fem::Sheet make_sheet(const fem::SurfaceMesh &mesh)
{
  fem::Sheet sheet = fem::MembraneSpace(mesh).make_sheet();
  sheet.material = {modulus * thickness / (1. - poisson * poisson), poisson, 0.,
                    0.};
  return sheet;
}

fem::SheetForces forces(const fem::Sheet &sheet, const Field &positions)
{
  fem::SheetForces out;
  fem::evaluate_forces(fem::BatchedSheet(sheet), positions, out);
  return out;
}

double dot(const Field &a, const Field &b)
{
  double sum = 0.;
  for (std::size_t k = 0; k < a.size(); ++k)
    sum += a[k].dot(b[k]);
  return sum;
}

Field along(const Field &x, double step, const Field &direction)
{
  Field out = x;
  for (std::size_t k = 0; k < x.size(); ++k)
    out[k] += step * direction[k];
  return out;
}

Eigen::Matrix3d some_rotation()
{
  return Eigen::AngleAxisd(1.1, Vector(1., -2., 0.5).normalized())
      .toRotationMatrix();
}

/// A square of side 1 m with its inner nodes shaken in the plane.
struct Patch
{
  static constexpr int n = 5;
  fem::SurfaceMesh mesh = support::flat_square(1., n);

  Patch()
  {
    const Field shaken = support::shaken(mesh.nodes, 0.05, 3);
    for (std::size_t k = 0; k < mesh.nodes.size(); ++k)
      if (!is_on_rim(k))
        mesh.nodes[k].head<2>() = shaken[k].head<2>();
  }
  static bool is_on_rim(std::size_t k)
  {
    const std::size_t i = k % (n + 1), j = k / (n + 1);
    return i == 0 || j == 0 || i == n || j == n;
  }
};

// Uniform stretches l1, l2 in a plane turned in space: P11 = l1 S11 with
// S11 = E h / (1 - nu^2) (E11 + nu E22), E11 = (l1^2 - 1) / 2. Bilinear quads
// reproduce it whatever their shape, so only round-off is allowed.
TEST(MembraneKernel, PatchTest)
{
  const Patch patch;
  const fem::Sheet sheet = make_sheet(patch.mesh);
  const double l1 = 1.3, l2 = 0.95;
  const Eigen::Matrix3d rotation = some_rotation();
  Field x;
  for (const Vector &node : patch.mesh.nodes)
    x.push_back(rotation * Vector(l1 * node.x(), l2 * node.y(), 0.) +
                Vector(3., 4., 5.));
  const fem::SheetForces f = forces(sheet, x);

  const double e1 = 0.5 * (l1 * l1 - 1.), e2 = 0.5 * (l2 * l2 - 1.);
  const double c = modulus * thickness / (1. - poisson * poisson);
  const double s1 = c * (e1 + poisson * e2), s2 = c * (e2 + poisson * e1);
  Vector pull = Vector::Zero();
  for (std::size_t k = 0; k < x.size(); ++k)
  {
    if (!Patch::is_on_rim(k))
    {
      EXPECT_LT(f.internal[k].norm(), 1e-12 * c);
    }
    if (k % (Patch::n + 1) == Patch::n)
      pull += f.internal[k];
  }
  EXPECT_LT((pull + rotation * Vector(l1 * s1, 0., 0.)).norm(), 1e-12 * c);
  const double energy = 0.5 * (s1 * e1 + s2 * e2);
  EXPECT_NEAR(f.strain_energy, energy, 1e-12 * energy);
  for (std::size_t k = 0; k < sheet.elements.size(); ++k)
  {
    const fem::SheetState state = fem::element_state(sheet, k, x);
    EXPECT_NEAR(state.area_ratio, l1 * l2, 1e-12);
    EXPECT_NEAR(state.energy_density, energy, 1e-12 * energy);
    EXPECT_NEAR(state.tension, 0.5 * (l1 / l2 * s1 + l2 / l1 * s2), 1e-12 * c);
  }
}

// Shear x = X + g Y: E12 = g / 2, E22 = g^2 / 2; S12 = E h / (1 + nu) E12.
TEST(MembraneKernel, SimpleShear)
{
  const Patch patch;
  const fem::Sheet sheet = make_sheet(patch.mesh);
  const double g = 0.2;
  Field x = patch.mesh.nodes;
  for (Vector &node : x)
    node.x() += g * node.y();
  const double s12 = modulus * thickness / (1. + poisson) * 0.5 * g;
  const double s22 =
      modulus * thickness / (1. - poisson * poisson) * 0.5 * g * g;
  const double energy = s12 * 0.5 * g + 0.5 * s22 * 0.5 * g * g;
  EXPECT_NEAR(forces(sheet, x).strain_energy, energy, 1e-12 * energy);
}

TEST(MembraneKernel, RigidMotionGivesNoForce)
{
  const fem::SurfaceMesh mesh = fem::cylinder_side(0.1, 0.2, 16, 6);
  const fem::Sheet sheet = make_sheet(mesh);
  Field x;
  for (const Vector &node : mesh.nodes)
    x.push_back(some_rotation() * node + Vector(1., -2., 3.));
  const fem::SheetForces f = forces(sheet, x);
  // Round-off of F is 1e-16 of the coordinates (3 m) over the quads (3 cm).
  for (const Vector &force : f.internal)
    EXPECT_LT(force.norm(), 1e-12 * modulus * thickness * 0.03);
  EXPECT_LT(f.strain_energy, 1e-20);
}

/// Every law, with and without tension.
class DeformedTube : public testing::TestWithParam<fem::SheetMaterial>
{
protected:
  void SetUp() override { sheet.material = GetParam(); }

  const fem::SurfaceMesh mesh = fem::cylinder_side(0.1, 0.2, 14, 5);
  fem::Sheet sheet = make_sheet(mesh);
  const Field x = support::shaken(mesh.nodes, 0.01, 5);
  const Field d = support::random_vectors(mesh.nodes.size(), 1., 6);
  /// The energy is smooth over a step of 2e-6 m, 4e-5 of a quad: central
  /// differences err by the square of that.
  static constexpr double step = 2e-6, tolerance = 1e-6;
};

constexpr double plane = modulus * thickness / (1. - poisson * poisson);
INSTANTIATE_TEST_SUITE_P(
    Laws, DeformedTube,
    testing::Values(
        fem::SheetMaterial{plane, poisson, 0., 0.},
        fem::SheetMaterial{plane, poisson, 0., 300.},
        fem::SheetMaterial{plane, poisson, modulus *thickness / 3., 0.},
        fem::SheetMaterial{plane, poisson, modulus *thickness / 3., 300.},
        fem::SheetMaterial{plane, poisson, 0., 0., true, 0.},
        fem::SheetMaterial{plane, poisson, 0., 300., true, 0.1},
        fem::SheetMaterial{plane, poisson, modulus *thickness / 3., 0., true,
                           0.1},
        fem::SheetMaterial{plane, poisson, modulus *thickness / 3., 300., true,
                           0.}));

// Uniform stretches l1, l2: Cauchy stress mu (l1^2 - 1 / (l1 l2)^2) over the
// thickness h / (l1 l2), and T l1 / l2 of the tension.
TEST(MembraneKernel, NeoHookePatchTest)
{
  const Patch patch;
  fem::Sheet sheet = make_sheet(patch.mesh);
  const double shear = 500., tension = 40., l1 = 1.7, l2 = 0.9;
  sheet.material.shear = shear;
  sheet.material.tension = tension;
  Field x;
  for (const Vector &node : patch.mesh.nodes)
    x.push_back(some_rotation() * Vector(l1 * node.x(), l2 * node.y(), 0.));
  const fem::SheetForces f = forces(sheet, x);
  const double l3 = 1. / (l1 * l2);
  const double first = l3 * shear * (l1 * l1 - l3 * l3) + tension * l1 / l2;
  const double second = l3 * shear * (l2 * l2 - l3 * l3) + tension * l2 / l1;
  Vector pull = Vector::Zero();
  for (std::size_t k = 0; k < x.size(); ++k)
  {
    if (!Patch::is_on_rim(k))
    {
      EXPECT_LT(f.internal[k].norm(), 1e-12 * shear);
    }
    if (k % (Patch::n + 1) == Patch::n)
      pull += f.internal[k];
  }
  EXPECT_LT((pull + some_rotation() * Vector(first * l2, 0., 0.)).norm(),
            1e-12 * shear);
  const double energy = 0.5 * shear * (l1 * l1 + l2 * l2 + l3 * l3 - 3.) +
                        0.5 * tension * (l1 * l1 + l2 * l2 - 2.);
  EXPECT_NEAR(f.strain_energy, energy, 1e-12 * energy);
  const fem::SheetState state = fem::element_state(sheet, 0, x);
  EXPECT_NEAR(state.energy_density, energy, 1e-12 * energy);
  EXPECT_NEAR(state.tension, 0.5 * (first + second), 1e-12 * shear);
}

/// A patch stretched by l1 and l2 along axes turned in the plane by `angle`.
fem::SheetForces stretched(const fem::SheetMaterial &material, double l1,
                           double l2, double angle = 0.)
{
  static const Patch patch;
  static fem::Sheet sheet = make_sheet(patch.mesh);
  sheet.material = material;
  const Eigen::Rotation2Dd turn(angle);
  const Eigen::Matrix2d stretch =
      turn * Eigen::Vector2d(l1, l2).asDiagonal() * turn.inverse();
  Field x;
  for (const Vector &node : patch.mesh.nodes)
  {
    const Eigen::Vector2d flat = stretch * node.head<2>();
    x.push_back(some_rotation() * Vector(flat.x(), flat.y(), 0.));
  }
  return forces(sheet, x);
}

/// Pull of the edge x = 1 along x, its size; the edge is 1 m long [N/m].
double edge_pull(const fem::SheetForces &f)
{
  Vector pull = Vector::Zero();
  for (std::size_t k = 0; k < f.internal.size(); ++k)
    if (k % (Patch::n + 1) == Patch::n)
      pull += f.internal[k];
  return pull.norm();
}

fem::SheetMaterial wrinkling(double shear, double tension = 0.)
{
  return {plane, poisson, shear, tension, true, 0.};
}

// Stress is E times strain along the wrinkles, nothing across, however far the
// strip is shortened there.
TEST(TensionField, WrinkledStripIsUniaxial)
{
  const double e1 = 0.5 * (1.3 * 1.3 - 1.), line = modulus * thickness * e1;
  for (const double l2 : {0.8, 0.5})
  {
    const fem::SheetForces f = stretched(wrinkling(0.), 1.3, l2);
    EXPECT_NEAR(edge_pull(f), 1.3 * line, 1e-12 * line);
    EXPECT_NEAR(f.strain_energy, 0.5 * line * e1, 1e-12 * line);
    EXPECT_LT(edge_pull(stretched(wrinkling(0.), l2, 1.3)), 1e-12 * line);
    // W = mu h / 2 (l^2 + 2 / l - 3), P = mu h (l - 1 / l^2).
    const double shear = 500., l = 1.3;
    const fem::SheetForces g = stretched(wrinkling(shear), l, l2);
    EXPECT_NEAR(edge_pull(g), shear * (l - 1. / (l * l)), 1e-12 * shear);
    EXPECT_NEAR(g.strain_energy, 0.5 * shear * (l * l + 2. / l - 3.),
                1e-12 * shear);
  }
}

// Natural width of the strip, nu strains of the length: taut beyond it.
TEST(TensionField, TautSheetIsThatOfTheLaw)
{
  for (const double shear : {0., 500.})
  {
    fem::SheetMaterial law = wrinkling(shear);
    const fem::SheetForces relaxed = stretched(law, 1.1, 0.98, 0.3);
    law.has_wrinkles = false;
    const fem::SheetForces plain = stretched(law, 1.1, 0.98, 0.3);
    EXPECT_EQ(relaxed.internal, plain.internal);
    EXPECT_EQ(relaxed.strain_energy, plain.strain_energy);
  }
}

TEST(TensionField, SlackSheetBearsNothing)
{
  for (const double shear : {0., 500.})
    for (const double l2 : {0.9, 0.6})
    {
      const fem::SheetForces f = stretched(wrinkling(shear), 0.9, l2, 0.4);
      EXPECT_LT(edge_pull(f), 1e-12 * plane);
      EXPECT_NEAR(f.strain_energy, 0., 1e-12 * plane);
    }
}

// From taut through wrinkled to slack and along turned axes: the energy has no
// jump, and is the work of the pull. Trapezoidal rule over a kinked curve.
TEST(TensionField, EnergyIsTheWorkOnTheWay)
{
  for (const double shear : {0., 500.})
    for (const double tension : {0., 60.})
    {
      const fem::SheetMaterial law = wrinkling(shear, tension);
      const int n = 2000;
      double work = 0., before = 0., energy = 0., start = 0.;
      for (int k = 0; k <= n; ++k)
      {
        const double l1 = 1.2 - 0.5 * k / n;
        const fem::SheetForces f = stretched(law, l1, 1.02 - 0.3 * k / n);
        // Across it is the same with the axes exchanged.
        const double across = edge_pull(stretched(law, 1.02 - 0.3 * k / n, l1));
        const double rate = 0.5 * edge_pull(f) + 0.3 * across;
        if (k == 0)
          start = f.strain_energy;
        else
          work += 0.5 * (rate + before) / n;
        before = rate;
        energy = f.strain_energy;
      }
      EXPECT_GT(start - energy, 1.);
      EXPECT_NEAR(work, start - energy, 1e-6 * (start - energy));
    }
}

// Pure shear by g at small strains: principal strains +-g/2, energy E h g^2 / 8
// against E h g^2 / (4 (1 + nu)) of the sheet that bears compression.
TEST(TensionField, ShearedSheetBearsItByTensionAlone)
{
  const double g = 1e-4, y = modulus * thickness;
  const double quarter = 0.25 * M_PI;
  EXPECT_NEAR(stretched(wrinkling(0.), 1. + 0.5 * g, 1. - 0.5 * g, quarter)
                  .strain_energy,
              y * g * g / 8., 2e-4 * y * g * g / 8.);
  fem::SheetMaterial law = wrinkling(0.);
  law.has_wrinkles = false;
  EXPECT_NEAR(stretched(law, 1. + 0.5 * g, 1. - 0.5 * g, quarter).strain_energy,
              y * g * g / (4. * (1. + poisson)), 2e-4 * y * g * g / 4.);
}

TEST_P(DeformedTube, StressIntegralIsTheVirialOfTheForces)
{
  Eigen::Matrix3d virial = Eigen::Matrix3d::Zero();
  const fem::SheetForces f = forces(sheet, x);
  for (std::size_t k = 0; k < x.size(); ++k)
    virial -= f.internal[k] * x[k].transpose();
  const Eigen::Matrix3d stress = fem::stress_integral(sheet, x);
  EXPECT_LT((stress - virial).norm(), 1e-12 * stress.norm());
}

TEST_P(DeformedTube, ForceIsDerivativeOfEnergy)
{
  const double slope = (forces(sheet, along(x, step, d)).strain_energy -
                        forces(sheet, along(x, -step, d)).strain_energy) /
                       (2. * step);
  EXPECT_NEAR(-dot(forces(sheet, x).internal, d), slope,
              tolerance * std::abs(slope));
}

TEST_P(DeformedTube, AreaIsDerivativeOfVolume)
{
  // With the rims at rest the lids do not change.
  Field inner = d;
  for (const double z : {0., 0.2})
    for (const std::int32_t node : fem::nodes_at_height(mesh, z, 1e-9))
      inner[static_cast<std::size_t>(node)].setZero();
  const auto rims = fem::find_rims(mesh);
  EXPECT_EQ(rims.size(), 2u);
  const double slope =
      (fem::enclosed_volume(mesh, rims, along(x, step, inner)) -
       fem::enclosed_volume(mesh, rims, along(x, -step, inner))) /
      (2. * step);
  EXPECT_NEAR(dot(forces(sheet, x).area, inner), slope,
              tolerance * std::abs(slope));
}

TEST_P(DeformedTube, TangentIsDerivativeOfForce)
{
  const double pressure = 3e4;
  Field tangent(x.size());
  fem::apply_tangent(sheet, x, pressure, d, tangent);
  const fem::SheetForces after = forces(sheet, along(x, step, d));
  const fem::SheetForces before = forces(sheet, along(x, -step, d));
  for (std::size_t k = 0; k < x.size(); ++k)
  {
    const Vector change = (after.internal[k] - before.internal[k]) -
                          pressure * (after.area[k] - before.area[k]);
    EXPECT_LT((tangent[k] + change / (2. * step)).norm(),
              tolerance * modulus * thickness);
  }
}

// 70 quads are eight batches and six elements more.
TEST_P(DeformedTube, EveryKernelGivesTheSameBits)
{
  const fem::SheetForces first = forces(sheet, x);
  for (const fem::BatchKernel kernel : fem::batch_kernels())
  {
    fem::SheetForces other;
    fem::evaluate_forces(fem::BatchedSheet(sheet, kernel), x, other);
    EXPECT_EQ(other.strain_energy, first.strain_energy);
    EXPECT_EQ(other.internal, first.internal);
    EXPECT_EQ(other.area, first.area);
  }
}

TEST_P(DeformedTube, ForcesHaveNoResultantAndNoMoment)
{
  Vector force = Vector::Zero(), moment = Vector::Zero();
  double scale = 0.;
  const fem::SheetForces f = forces(sheet, x);
  for (std::size_t k = 0; k < x.size(); ++k)
  {
    force += f.internal[k];
    moment += x[k].cross(f.internal[k]);
    scale += f.internal[k].norm();
  }
  EXPECT_LT(force.norm(), 1e-14 * scale);
  EXPECT_LT(moment.norm(), 1e-14 * scale);
}

TEST_P(DeformedTube, LargestFrequencyMatchesDenseEigenvalues)
{
  // Tied rims: then the load stiffness is symmetric, as Lanczos wants it.
  std::vector<double> mass = fem::MembraneSpace(mesh).nodal_area();
  for (double &m : mass)
    m *= 1100. * thickness;
  std::vector<std::uint8_t> tied(x.size(), 0);
  for (const double z : {0., 0.2})
    for (const std::int32_t node : fem::nodes_at_height(mesh, z, 1e-9))
      tied[static_cast<std::size_t>(node)] = 7;

  const double pressure = 1e4;
  const auto n = static_cast<Eigen::Index>(3 * x.size());
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
  Field column(x.size());
  for (Eigen::Index j = 0; j < n; ++j)
  {
    const auto to = static_cast<std::size_t>(j / 3);
    if (tied[to])
      continue;
    Field unit(x.size(), Vector::Zero());
    unit[to](j % 3) = 1. / std::sqrt(mass[to]);
    fem::apply_tangent(sheet, x, pressure, unit, column);
    for (std::size_t k = 0; k < x.size(); ++k)
      if (!tied[k])
        dense.block<3, 1>(static_cast<Eigen::Index>(3 * k), j) =
            column[k] / std::sqrt(mass[k]);
  }
  EXPECT_LT((dense - dense.transpose()).norm(), 1e-12 * dense.norm());
  const double exact =
      std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense)
                    .eigenvalues()
                    .maxCoeff());
  const fem::Followers none({}, x.size());
  EXPECT_NEAR(fem::largest_frequency(sheet, {mass, tied, none}, x, pressure),
              exact, 1e-4 * exact);
}
} // namespace
