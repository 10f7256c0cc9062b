// Why generated particles have more corners than their sample: the share of
// corners of the sample when the phases of its fine degrees are changed, as
// docs/verification/shapes.md has it.
//
//   shape_phases SHAPES [SHAPES ...]
#include <dem/random.h>
#include <dem/shape/measures.h>
#include <dem/shape/spherical_harmonics.h>

#include <cmath>
#include <cstdio>
#include <log_shape.h>
#include <numbers>
#include <shape/file.h>
#include <string>
#include <vector>

namespace
{
using dem::detail::LogShape;

constexpr int order = 20, n_repeats = 12;

double &coefficient(std::vector<double> &b, int n, int m)
{
  return b[static_cast<std::size_t>(dem::harmonic_index(n, m))];
}

double energy(std::vector<double> &b, int n)
{
  double sum = 0.;
  for (int m = -n; m <= n; ++m)
    sum += std::pow(coefficient(b, n, m), 2);
  return sum;
}

/// The degrees from `first` on are those of `fine`, with the energy that each
/// had.
void set_fine(std::vector<double> &b, std::vector<double> fine, int first)
{
  for (int n = first; n <= order; ++n)
  {
    const double factor = std::sqrt(energy(b, n) / energy(fine, n));
    for (int m = -n; m <= n; ++m)
      coefficient(b, n, m) = factor * coefficient(fine, n, m);
  }
}

std::vector<double> random_field(dem::Random &random)
{
  std::vector<double> field(
      static_cast<std::size_t>(dem::n_coefficients(order)));
  for (double &b : field) // Box and Muller
    b = std::sqrt(-2. * std::log(1. - random.uniform())) *
        std::cos(2. * std::numbers::pi * random.uniform());
  return field;
}

std::vector<double> turned(const std::vector<double> &b, dem::Random &random)
{
  const dem::SphereQuadrature &rule = dem::standard_quadrature();
  const dem::Mat3 rotation = random.rotation().toRotationMatrix();
  std::vector<double> sum(b.size(), 0.), harmonics(b.size());
  for (std::size_t k = 0; k < rule.direction.size(); ++k)
  {
    const dem::Vec3 &s = rule.direction[k];
    const double part = rule.weight[k] * dem::radius(b, rotation * s);
    dem::evaluate_harmonics(order, s, harmonics);
    for (std::size_t j = 0; j < sum.size(); ++j)
      sum[j] += part * harmonics[j];
  }
  return sum;
}

/// Mean share of corners of what `change` makes of the particles.
template <class Change>
void print_share(const std::string &what,
                 const std::vector<LogShape> &particles, const Change &change)
{
  double sum = 0.;
  int n = 0;
  for (int repeat = 0; repeat < n_repeats; ++repeat)
    for (LogShape particle : particles)
    {
      change(particle);
      const dem::Coefficients shape = dem::detail::from_log(particle);
      if (shape.empty())
        continue;
      sum +=
          dem::measure_shape(shape, dem::standard_quadrature()).corner_fraction;
      ++n;
    }
  std::printf("| %s | %.3f |\n", what.c_str(), sum / n);
}
} // namespace

int main(int argc, char **argv)
{
  std::vector<LogShape> particles;
  double share = 0.;
  for (int k = 1; k < argc; ++k)
    for (const spall::ShapeFile &shape : spall::read_shapes(argv[k]))
    {
      particles.push_back(dem::detail::log_shape(shape.coefficients, order));
      share +=
          dem::measure_shape(shape.coefficients, dem::standard_quadrature())
              .corner_fraction;
    }
  if (particles.empty())
  {
    std::fprintf(stderr, "shape_phases SHAPES [SHAPES ...]\n");
    return 1;
  }
  dem::Random random(5);
  std::printf(
      "| particles | share of corners |\n|---|---|\n| sample | %.3f |\n",
      share / static_cast<double>(particles.size()));
  print_share("sample, taken apart and put together", particles,
              [](LogShape &) {});
  for (const int first : {15, 9, 5})
    print_share("random phases from degree " + std::to_string(first), particles,
                [&](LogShape &of)
                { set_fine(of.coefficients, random_field(random), first); });
  print_share("degrees from 9, turned at random", particles,
              [&](LogShape &of) {
                set_fine(of.coefficients, turned(of.coefficients, random), 9);
              });
  print_share("degrees from 9 of another particle", particles,
              [&](LogShape &of)
              {
                const auto other = static_cast<std::size_t>(
                    random.uniform() * static_cast<double>(particles.size()));
                set_fine(of.coefficients, particles[other].coefficients, 9);
              });
  return 0;
}
