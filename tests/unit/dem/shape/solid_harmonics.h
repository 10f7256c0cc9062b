#pragma once

#include <dem/shape/spherical_harmonics.h>

#include <cmath>
#include <complex>
#include <vector>

/// The series again by another way and with more digits: solid harmonics
/// R_nm = |x|^n P_nm(cos theta) e^(i m phi) / (n + m)! and their derivatives
/// d_z R_nm = R_(n-1)m, (d_x + i d_y) R_nm = -R_(n-1)(m+1),
/// (d_x - i d_y) R_nm = R_(n-1)(m-1), all in long double.
namespace dem::test
{
using Long = long double;
using LongComplex = std::complex<Long>;
using LongVec3 = Eigen::Matrix<Long, 3, 1>;
using LongMat3 = Eigen::Matrix<Long, 3, 3>;

class SolidHarmonics
{
public:
  SolidHarmonics(int order, const LongVec3 &s)
  {
    const LongComplex planar(s.x(), s.y());
    for (int n = 0; n <= order; ++n)
    {
      rows.emplace_back();
      for (int m = 0; m <= n; ++m)
        rows[std::size_t(n)].push_back(
            m == n ? (n == 0 ? LongComplex(1)
                             : at(n - 1, n - 1) * planar / Long(2 * n))
                   : (Long(2 * n - 1) * s.z() * at(n - 1, m) -
                      s.squaredNorm() * at(n - 2, m)) /
                         Long(n * n - m * m));
    }
  }

  LongComplex at(int n, int m) const
  {
    if (n < 0 || std::abs(m) > n)
      return 0;
    const LongComplex up = rows[std::size_t(n)][std::size_t(std::abs(m))];
    return m >= 0 ? up : (m % 2 == 0 ? Long(1) : Long(-1)) * std::conj(up);
  }

private:
  std::vector<std::vector<LongComplex>> rows;
};

/// Complex value, gradient and second derivatives of one R_nm.
struct SolidJet
{
  LongComplex value;
  Eigen::Matrix<LongComplex, 3, 1> gradient;
  Eigen::Matrix<LongComplex, 3, 3> second;
};

/// plus = d_x + i d_y, minus = d_x - i d_y of what has them.
inline SolidJet solid_jet(const SolidHarmonics &r, int n, int m)
{
  const LongComplex i(0, 1), half(0.5L), quarter(0.25L);
  const LongComplex plus = -r.at(n - 1, m + 1), minus = r.at(n - 1, m - 1);
  const LongComplex plus2 = r.at(n - 2, m + 2), minus2 = r.at(n - 2, m - 2);
  const LongComplex both = -r.at(n - 2, m);
  const LongComplex plus_z = -r.at(n - 2, m + 1), minus_z = r.at(n - 2, m - 1);
  SolidJet jet;
  jet.value = r.at(n, m);
  jet.gradient << half * (plus + minus), half * (plus - minus) / i,
      r.at(n - 1, m);
  const LongComplex xx = quarter * (plus2 + minus2 + both + both);
  const LongComplex yy = -quarter * (plus2 + minus2 - both - both);
  const LongComplex xy = quarter * (plus2 - minus2) / i;
  const LongComplex xz = half * (plus_z + minus_z);
  const LongComplex yz = half * (plus_z - minus_z) / i;
  jet.second << xx, xy, xz, xy, yy, yz, xz, yz, r.at(n - 2, m);
  return jet;
}

struct LongExpansion
{
  LongVec3 direction;
  Long radius = 0;
  LongVec3 gradient = LongVec3::Zero();
  LongMat3 hessian = LongMat3::Zero();
};

/// sqrt((2 n + 1) / (4 pi) (n - m)! / (n + m)!) (n + m)!, sqrt 2 for m > 0.
inline Long solid_factor(int n, int m)
{
  const Long pi = std::acos(Long(-1));
  return std::sqrt((2 * n + 1) / (4 * pi) * (m > 0 ? 2 : 1) *
                   std::tgamma(Long(n - m + 1)) * std::tgamma(Long(n + m + 1)));
}

/// Each degree: g = P grad S, H = P grad grad S P - n S P.
inline LongExpansion long_expansion(const std::vector<double> &a,
                                    const Vec3 &at)
{
  LongExpansion sum;
  sum.direction = at.cast<Long>().normalized();
  const LongVec3 &s = sum.direction;
  const LongMat3 tangent = LongMat3::Identity() - s * s.transpose();
  const int order = order_of(a.size());
  const SolidHarmonics harmonics(order, s);
  for (int n = 0; n <= order; ++n)
    for (int m = -n; m <= n; ++m)
    {
      const SolidJet jet = solid_jet(harmonics, n, std::abs(m));
      const Long by = solid_factor(n, std::abs(m)) *
                      Long(a[std::size_t(harmonic_index(n, m))]);
      const auto part = [&](const LongComplex &z)
      { return by * (m < 0 ? z.imag() : z.real()); };
      const LongVec3 gradient = jet.gradient.unaryExpr(part).real();
      const LongMat3 second = jet.second.unaryExpr(part).real();
      sum.radius += part(jet.value);
      sum.gradient += tangent * gradient;
      sum.hessian += tangent * second * tangent - n * part(jet.value) * tangent;
    }
  return sum;
}

struct LongCurvatures
{
  Long maximum, minimum;
};

inline LongCurvatures long_curvatures(const LongExpansion &at)
{
  const LongVec3 first = at.direction.unitOrthogonal();
  Eigen::Matrix<Long, 3, 2> frame;
  frame << first, at.direction.cross(first);
  const Eigen::Matrix<Long, 2, 1> slope = frame.transpose() * at.gradient;
  const Eigen::Matrix<Long, 2, 2> bend = frame.transpose() * at.hessian * frame;
  const Eigen::Matrix<Long, 2, 2> unit = Eigen::Matrix<Long, 2, 2>::Identity();
  const Long r = at.radius, w = std::sqrt(r * r + slope.squaredNorm());
  const Eigen::Matrix<Long, 2, 2> metric =
      r * r * unit + slope * slope.transpose();
  const Eigen::Matrix<Long, 2, 2> shape =
      metric.inverse() *
      (r * r * unit + 2 * slope * slope.transpose() - r * bend) / w;
  const Long mean = shape.trace() / 2;
  const Long gap =
      std::sqrt(std::max(Long(0), mean * mean - shape.determinant()));
  return {mean + gap, mean - gap};
}
} // namespace dem::test
