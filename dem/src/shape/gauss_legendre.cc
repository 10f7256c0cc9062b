#include "gauss_legendre.h"

#include <cmath>
#include <numbers>

namespace dem::detail
{
namespace
{
struct Legendre
{
  double value, slope;
};

Legendre legendre(int n, double x)
{
  double before = 1., value = x;
  for (int k = 2; k <= n; ++k)
  {
    const double next = ((2. * k - 1.) * x * value - (k - 1.) * before) / k;
    before = value;
    value = next;
  }
  return {value, n * (x * value - before) / ((x - 1.) * (x + 1.))};
}
} // namespace

LineRule gauss_legendre(int n)
{
  LineRule rule;
  for (int i = n - 1; i >= 0; --i)
  {
    double x = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5));
    // quadratic: five steps from a guess within 1e-3 reach round-off
    for (int step = 0; step < 5; ++step)
    {
      const Legendre p = legendre(n, x);
      x -= p.value / p.slope;
    }
    const double slope = legendre(n, x).slope;
    rule.node.push_back(x);
    rule.weight.push_back(2. / ((1. - x) * (1. + x) * slope * slope));
  }
  return rule;
}
} // namespace dem::detail
