#include <dem/assert.h>
#include <dem/contact/elliptic.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <sstream>
#include <stdexcept>

namespace dem
{
namespace
{
constexpr double pi = std::numbers::pi;
/// Longest ellipse of the table, B / A [-].
constexpr double max_ratio = 1e4;
/// 20 terms leave 3e-11 of both functions (measured in the unit test).
constexpr int n_terms = 20;

/// Complete elliptic integrals of the modulus e, complement k' = b / a [-]:
/// K, E, D = (K - E) / e^2, B = (E - k'^2 K) / e^2.
struct EllipticIntegrals
{
  double K = 0., E = 0., D = 0., B = 0.;
};

/// Arithmetic-geometric mean. The sum 2^(j-1) c_j^2 is divided by e^2 term by
/// term (c_0 = e exactly), so that D and B need no limit as e -> 0.
EllipticIntegrals elliptic_integrals(double complement)
{
  double mean = 1., geometric = complement;
  double square = (1. - complement) * (1. + complement); // c_j^2
  double scaled = 1.;                                    // c_j^2 / e^2
  double sum = 0.5, power = 0.5;
  while (square > 1e-34 * mean * mean)
  {
    const double next = 0.5 * (mean + geometric);
    geometric = std::sqrt(mean * geometric);
    mean = next;
    // c_(j+1) = c_j^2 / (4 a_(j+1)): no difference of neighbours.
    const double factor = square / (16. * mean * mean);
    square *= factor;
    scaled *= factor;
    power *= 2.;
    sum += power * scaled;
  }
  EllipticIntegrals result;
  result.K = pi / (2. * mean);
  result.D = result.K * sum;
  result.B = result.K - result.D;
  result.E = result.B + complement * complement * result.D;
  return result;
}

/// b / a for B / A = B_c / (D k'^2), which falls monotonically to 1 at k' = 1.
double solve_complement(double ratio)
{
  double lower = -std::log(ratio), upper = 0.;
  if (!(lower < 0.))
    return 1.;
  for (int step = 0; step < 60; ++step)
  {
    const double middle = 0.5 * (lower + upper);
    const double complement = std::exp(middle);
    const EllipticIntegrals integral = elliptic_integrals(complement);
    const bool is_too_long =
        integral.B > ratio * integral.D * complement * complement;
    (is_too_long ? lower : upper) = middle;
  }
  return std::exp(0.5 * (lower + upper));
}

/// Coefficients of the Chebyshev interpolant through values at the nodes
/// cos(pi (k + 1/2) / n); the first one is halved already.
std::vector<double> chebyshev_coefficients(const std::vector<double> &value)
{
  const std::size_t n = value.size();
  std::vector<double> coefficient(n, 0.);
  for (std::size_t order = 0; order < n; ++order)
  {
    for (std::size_t k = 0; k < n; ++k)
      coefficient[order] += value[k] * std::cos(pi * order * (k + 0.5) / n);
    coefficient[order] *= (order == 0 ? 1. : 2.) / n;
  }
  return coefficient;
}

void check_elasticity(const Elasticity &body)
{
  if (body.is_rigid)
    return;
  std::ostringstream message;
  if (!(body.shear_modulus > 0.) || !std::isfinite(body.shear_modulus))
    message << "shear modulus is " << body.shear_modulus
            << " Pa; a positive number is needed";
  else if (!(body.poisson_ratio > -1. && body.poisson_ratio <= 0.5))
    message << "Poisson's ratio is " << body.poisson_ratio
            << "; more than -1 and at most 0.5 is allowed";
  if (!message.str().empty())
    throw std::invalid_argument(message.str());
}
} // namespace

PairElasticity mix(const Elasticity &a, const Elasticity &b)
{
  if (a.is_rigid && b.is_rigid)
    throw std::invalid_argument(
        "both bodies of a contact are rigid; at least one must be elastic");
  double inverse_modulus = 0.;
  PairElasticity pair;
  for (const Elasticity *body : {&a, &b})
  {
    check_elasticity(*body);
    if (body->is_rigid)
      continue;
    const double compliance = 1. / body->shear_modulus;
    inverse_modulus += 0.5 * (1. - body->poisson_ratio) * compliance;
    pair.compliance += compliance;
    pair.cross_compliance += body->poisson_ratio * compliance;
  }
  pair.modulus = 1. / inverse_modulus;
  return pair;
}

// 2 (A + B) = sum of all curvatures and, with d = kappa_1 - kappa_2,
// 4 A B = (k1a + k1b) (k2a + k2b) + d_a d_b sin^2 psi: Johnson (1985), 4.1,
// multiplied out.
GapCoefficients gap_coefficients(const PairCurvatures &curvatures)
{
  const double first = curvatures.first_a + curvatures.first_b;
  const double second = curvatures.second_a + curvatures.second_b;
  const double difference_a = curvatures.first_a - curvatures.second_a;
  const double difference_b = curvatures.first_b - curvatures.second_b;
  const double square = difference_a * difference_a +
                        difference_b * difference_b +
                        2. * difference_a * difference_b * curvatures.cos_2psi;
  const double product = first * second + 0.5 * difference_a * difference_b *
                                              (1. - curvatures.cos_2psi);
  GapCoefficients gap;
  gap.b = 0.25 * (first + second + std::sqrt(std::max(0., square)));
  DEM_ASSERT(gap.b > 0.);
  gap.a = std::clamp(0.25 * product / gap.b, 1e-12 * gap.b, gap.b);
  return gap;
}

EllipticContact solve_elliptic(const PairElasticity &pair,
                               const GapCoefficients &gap)
{
  DEM_ASSERT(gap.a > 0. && gap.b >= gap.a);
  const double complement = solve_complement(gap.b / gap.a);
  const EllipticIntegrals integral = elliptic_integrals(complement);
  EllipticContact contact;
  contact.K = integral.K;
  contact.E = integral.E;
  contact.eccentricity = std::sqrt((1. - complement) * (1. + complement));
  contact.axis_ratio = 1. / complement;
  contact.minor_axis = std::sqrt(integral.E / (integral.K * (gap.a + gap.b)));
  contact.major_axis = contact.minor_axis / complement;
  contact.prefactors.normal =
      2. / 3. * pi * contact.major_axis * pair.modulus / integral.K;
  const double load = 2. * pi * contact.major_axis;
  contact.ks_major = load / (pair.compliance * integral.K -
                             pair.cross_compliance * integral.B);
  contact.ks_minor = load / (pair.compliance * integral.K -
                             pair.cross_compliance * integral.D);
  contact.prefactors.tangential = 0.5 * (contact.ks_major + contact.ks_minor);
  return contact;
}

EllipticTable::EllipticTable()
{
  for (int k = 0; k < n_terms; ++k)
  {
    const double node = std::cos(pi * (k + 0.5) / n_terms);
    const double ratio = std::exp(0.5 * (node + 1.) * std::log(max_ratio));
    const double complement = solve_complement(ratio);
    const EllipticIntegrals integral = elliptic_integrals(complement);
    // A = 1, B = ratio: f_F = pi a / (2 K sqrt(R_g)).
    const double major_axis =
        std::sqrt(integral.E / (integral.K * (1. + ratio))) / complement;
    const double radius = 0.5 / std::sqrt(ratio);
    force.push_back(0.5 * pi * major_axis / (integral.K * std::sqrt(radius)));
    directional.push_back(integral.B / integral.K);
  }
  force = chebyshev_coefficients(force);
  directional = chebyshev_coefficients(directional);
}

HertzPrefactors EllipticTable::operator()(const PairElasticity &pair,
                                          const GapCoefficients &gap) const
{
  static const double scale = 2. / std::log(max_ratio);
  const double a = std::max(gap.a, gap.b / max_ratio);
  const double x = scale * std::log(gap.b / a) - 1.;

  // Clenshaw's recurrence, both series at once.
  double f = 0., f_next = 0., q = 0., q_next = 0.;
  for (std::size_t k = force.size(); k-- > 1;)
  {
    const double f_old = f, q_old = q;
    f = 2. * x * f - f_next + force[k];
    q = 2. * x * q - q_next + directional[k];
    f_next = f_old;
    q_next = q_old;
  }
  f = x * f - f_next + force[0];
  q = x * q - q_next + directional[0];

  // sqrt(R_g) f.
  const double strength = f / std::sqrt(2. * std::sqrt(a * gap.b));
  const double along_major = pair.compliance - q * pair.cross_compliance;
  const double along_minor = pair.compliance - (1. - q) * pair.cross_compliance;
  return {4. / 3. * pair.modulus * strength,
          2. * strength * (1. / along_major + 1. / along_minor)};
}

const EllipticTable &elliptic_table()
{
  static const EllipticTable table;
  return table;
}
} // namespace dem
