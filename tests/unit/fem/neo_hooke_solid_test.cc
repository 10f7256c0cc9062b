#include <fem/neo_hooke.h>

#include <gtest/gtest.h>

namespace
{
using Matrix = Eigen::Matrix3d;

const fem::NeoHooke rubber{2e5, 3e6};

Matrix stretched()
{
  Matrix f;
  f << 1.3, 0.2, -0.1, 0.05, 0.8, 0.3, -0.2, 0.1, 1.1;
  return f;
}

Matrix rotation()
{
  return Eigen::AngleAxisd(1.2, Eigen::Vector3d(1., -2., 0.5).normalized())
      .toRotationMatrix();
}

TEST(NeoHooke, StressIsTheDerivativeOfTheEnergy)
{
  const Matrix stress = fem::shape_stress(rubber, stretched());
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
    {
      Matrix up = stretched(), down = up;
      up(i, j) += 1e-6;
      down(i, j) -= 1e-6;
      const double numeric =
          (fem::shape_energy(rubber, up) - fem::shape_energy(rubber, down)) /
          2e-6;
      EXPECT_NEAR(stress(i, j), numeric, 1e-7 * stress.norm());
    }
  const double slope = (fem::volume_energy(rubber, 0.8 + 1e-6) -
                        fem::volume_energy(rubber, 0.8 - 1e-6)) /
                       2e-6;
  EXPECT_NEAR(fem::volume_stress(rubber, 0.8), slope, 1e-7 * 3e6);
}

TEST(NeoHooke, TangentIsTheDerivativeOfTheStress)
{
  Matrix change;
  change << 0.3, -1., 0.7, 0.2, 0.5, -0.4, 0.9, 0.1, -0.6;
  const double h = 1e-6;
  const Matrix numeric = (fem::shape_stress(rubber, stretched() + h * change) -
                          fem::shape_stress(rubber, stretched() - h * change)) /
                         (2. * h);
  const Matrix tangent = fem::shape_stress_change(rubber, stretched(), change);
  EXPECT_LT((tangent - numeric).norm(), 1e-7 * numeric.norm());
  const double slope = (fem::volume_stress(rubber, 0.8 + h) -
                        fem::volume_stress(rubber, 0.8 - h)) /
                       (2. * h);
  EXPECT_NEAR(fem::volume_stiffness(rubber, 0.8), slope, 1e-7 * slope);
}

TEST(NeoHooke, TurningTurnsTheStressOnly)
{
  const Matrix f = stretched();
  EXPECT_NEAR(fem::shape_energy(rubber, rotation() * f),
              fem::shape_energy(rubber, f), 1e-9 * 2e5);
  EXPECT_LT((fem::shape_stress(rubber, rotation() * f) -
             rotation() * fem::shape_stress(rubber, f))
                .norm(),
            1e-9 * 2e5);
  // No volume change, no energy of it; a shape that only grows has none.
  EXPECT_NEAR(fem::shape_energy(rubber, 1.7 * rotation()), 0., 1e-9 * 2e5);
  EXPECT_EQ(fem::volume_stress(rubber, 1.), 0.);
}

// For small strains Hooke's law with mu and K.
TEST(NeoHooke, BeginsAsHooke)
{
  const Matrix shear =
      (Matrix() << 0., 1., 0., 0., 0., 0., 0., 0., 0.).finished();
  const Matrix stress =
      fem::shape_stress_change(rubber, Matrix::Identity(), shear);
  EXPECT_NEAR(stress(0, 1), 2e5, 1e-6);
  EXPECT_NEAR(stress(1, 0), 2e5, 1e-6);
  EXPECT_NEAR(fem::volume_stiffness(rubber, 1.), 3e6, 1e-6);
}
} // namespace
