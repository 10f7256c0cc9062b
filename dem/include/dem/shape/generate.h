#pragma once

#include <dem/random.h>
#include <dem/shape/particle_shape.h>

namespace dem
{
namespace detail
{
struct LogShape;
}

/// New particles with the statistics of a sample
/// (docs/theory/shape_generation.md). In its principal frame log r of a
/// particle is that of its ellipsoid of inertia and a series. Mirror images
/// count as particles as well: so the coefficients fall into eight classes by
/// parity in x, y, z, which are independent, and all but the even class have
/// mean zero. Degrees 1 to 4 are normal within their class with the covariance
/// of the sample; in the even class with them go elongation, flatness and the
/// logarithm of the amplitude of the higher degrees, which have random phases
/// and the mean spectrum of the sample. The values of the series get the mean
/// quantiles of the sample.
class ShapeGenerator
{
public:
  /// Throws std::invalid_argument with fewer than three shapes, an order of the
  /// particles below 5 or above max_order, or a shape of an order below 4.
  ShapeGenerator(std::span<const Coefficients> sample, int order);

  /// The next particle: star-shaped, its volume that of a sphere of radius
  /// `volume_equivalent_radius()`, its centroid at the origin, long axis x,
  /// short axis z (nearly). The same for the same state of the random numbers.
  Coefficients operator()(Random &random) const;

  /// Geometric mean over the sample of the radius of the sphere of the same
  /// volume [m].
  double volume_equivalent_radius() const { return radius; }

private:
  /// Numbers that are drawn together: mean + factor * normal numbers.
  struct Normal
  {
    std::vector<int> index; ///< in a row of coefficients; negative: no harmonic
    Eigen::VectorXd mean;
    Eigen::MatrixXd factor; ///< a root of the covariance
  };

  Normal fit_class(const std::vector<detail::LogShape> &logs, int parity) const;
  void fit_spectrum(const std::vector<detail::LogShape> &logs);
  detail::LogShape draw(Random &random) const;

  int order;
  double radius = 0.;            ///< [m]
  std::vector<Normal> classes;   ///< of degrees 1 to 4
  std::vector<double> quantiles; ///< mean of the sample, see LogShape
  std::vector<double> spectrum;  ///< share of a degree above 4 in the energy
};
} // namespace dem
