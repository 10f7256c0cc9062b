#pragma once

#include <dem/vector.h>

#include <cmath>

/// Symmetric 2 x 2 matrices in the plane across a normal.
namespace dem
{
using Mat2 = Eigen::Matrix2d;
using Vec2 = Eigen::Vector2d;
using Frame = Eigen::Matrix<double, 3, 2>;

/// Two unit vectors across n.
inline Frame tangents(const Vec3 &n)
{
  Frame frame;
  frame.col(0) = n.unitOrthogonal();
  frame.col(1) = n.cross(frame.col(0));
  return frame;
}

/// Smallest eigenvalue of a symmetric matrix.
inline double smallest_eigenvalue(const Mat2 &m)
{
  const double half = 0.5 * (m(0, 0) - m(1, 1));
  return 0.5 * (m(0, 0) + m(1, 1)) - std::sqrt(half * half + m(0, 1) * m(0, 1));
}

/// Raises the eigenvalues of a symmetric matrix to at least `floor`.
inline Mat2 floored(const Mat2 &m, double floor)
{
  if (smallest_eigenvalue(m) >= floor)
    return m;
  Eigen::SelfAdjointEigenSolver<Mat2> axes;
  axes.computeDirect(m);
  return axes.eigenvectors() * axes.eigenvalues().cwiseMax(floor).asDiagonal() *
         axes.eigenvectors().transpose();
}

inline Vec3 shortened(const Vec3 &step, double limit)
{
  const double length = step.norm();
  return length > limit ? Vec3(step * (limit / length)) : step;
}
} // namespace dem
