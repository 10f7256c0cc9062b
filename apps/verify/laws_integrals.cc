#include "laws_cases.h"

#include <algorithm>
#include <cmath>
#include <numbers>

// The tractions integrated over the ellipse: C_H, a, b, K, E and k_s without
// any elliptic function.
namespace spall::verify
{
namespace
{
struct Ellipse
{
  double a = 0., b = 0.; ///< semi-axes [m]
};

constexpr double overlap = 2e-4; // [m]
constexpr int n_angles = 4000;

Ellipse ellipse_of(const dem::EllipticContact &contact)
{
  return {contact.major_axis * std::sqrt(overlap),
          contact.minor_axis * std::sqrt(overlap)};
}

/// int over the ellipse of sqrt(1 - (x/a)^2 - (y/b)^2) / r, r from (x, y)
/// inside: along a chord through that point the root is a half circle, and the
/// rest is periodic in the angle, so the trapezoidal rule is exact to
/// round-off for enough angles [m].
double normal_potential(const Ellipse &ellipse, double x, double y)
{
  const double a2 = ellipse.a * ellipse.a, b2 = ellipse.b * ellipse.b;
  const double start = 1. - x * x / a2 - y * y / b2;
  double sum = 0.;
  for (int k = 0; k < n_angles; ++k)
  {
    const double angle = std::numbers::pi * k / n_angles;
    const double c = std::cos(angle), s = std::sin(angle);
    const double slope = x * c / a2 + y * s / b2;
    const double bend = c * c / a2 + s * s / b2;
    sum += 0.5 * std::numbers::pi * (start + slope * slope / bend) /
           std::sqrt(bend);
  }
  return std::numbers::pi / n_angles * sum;
}

/// int of (1 - nu + nu cos^2(theta - direction)) / (r sqrt(1 - ...)) from the
/// centre: along a ray the root gives pi / 2 times its length [m].
double tangential_potential(const Ellipse &ellipse, double poisson_ratio,
                            bool is_along_major)
{
  double sum = 0.;
  for (int k = 0; k < n_angles; ++k)
  {
    const double angle = 2. * std::numbers::pi * k / n_angles;
    const double c = std::cos(angle), s = std::sin(angle);
    const double length = 1. / std::hypot(c / ellipse.a, s / ellipse.b);
    const double along = is_along_major ? c : s;
    sum += 0.5 * std::numbers::pi * length *
           (1. - poisson_ratio + poisson_ratio * along * along);
  }
  return 2. * std::numbers::pi / n_angles * sum;
}

/// Largest misfit of the surfaces over the overlap where the ellipse lies.
double worst_gap(const dem::PairElasticity &pair,
                 const dem::GapCoefficients &gap)
{
  const dem::EllipticContact contact = dem::solve_elliptic(pair, gap);
  const Ellipse ellipse = ellipse_of(contact);
  const double force = contact.prefactors.normal * std::pow(overlap, 1.5);
  const double pressure =
      1.5 * force / (std::numbers::pi * ellipse.a * ellipse.b);
  double worst = 0.;
  for (const auto &[u, v] :
       {std::pair{0., 0.}, {0.6, 0.}, {0., 0.7}, {0.5, 0.5}})
  {
    const double x = u * ellipse.a, y = v * ellipse.b;
    const double moved = pressure / (std::numbers::pi * pair.modulus) *
                         normal_potential(ellipse, x, y);
    const double closed = overlap - gap.a * x * x - gap.b * y * y;
    worst = std::max(worst, std::abs(moved - closed) / overlap);
  }
  return worst;
}

/// k_s times the compliance of the traction q_0 / sqrt(1 - x^2/a^2 - y^2/b^2),
/// Q = 2 pi a b q_0, which moves the centre of body i by
/// int q (1 - nu + nu cos^2) / (2 pi G r).
double stiffness_times_compliance(const dem::EllipticContact &contact,
                                  bool is_along_major)
{
  const Ellipse ellipse = ellipse_of(contact);
  double compliance = 0.;
  for (const dem::Elasticity &body : {aggregate, steel})
    compliance +=
        tangential_potential(ellipse, body.poisson_ratio, is_along_major) /
        (2. * std::numbers::pi * body.shear_modulus) /
        (2. * std::numbers::pi * ellipse.a * ellipse.b);
  return (is_along_major ? contact.ks_major : contact.ks_minor) *
         std::sqrt(overlap) * compliance;
}

constexpr double ratios[] = {1., 1.3, 5., 40., 400.};
} // namespace

// The pressure p_0 sqrt(1 - x^2/a^2 - y^2/b^2) that carries F must move the
// surfaces by delta - A x^2 - B y^2 everywhere inside. 1e-11: round-off of 4000
// terms.
std::vector<Row> pressure_integral()
{
  double worst = 0.;
  for (const double ratio : ratios)
    worst = std::max(worst,
                     worst_gap(dem::mix(aggregate, steel), {30., 30. * ratio}));
  return {at_most("worst misfit of the gap over the overlap, B/A to 400", "-",
                  worst, 1e-11)};
}

std::vector<Row> traction_integral()
{
  double worst = 0.;
  for (const double ratio : ratios)
  {
    const dem::EllipticContact contact =
        dem::solve_elliptic(dem::mix(aggregate, steel), {30., 30. * ratio});
    for (const bool is_along_major : {true, false})
      worst = std::max(
          worst,
          std::abs(stiffness_times_compliance(contact, is_along_major) - 1.));
  }
  return {at_most("worst error of k_s along both axes, B/A to 400", "-", worst,
                  1e-11)};
}
} // namespace spall::verify
