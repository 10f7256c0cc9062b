#include <dem/integrate/stable_step.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

namespace dem
{
namespace
{
using Field = Eigen::VectorXd;

/// M^(-1/2) (dt^2 K + 2 dt C) M^(-1/2); six unknowns per body: motion and
/// turning, which is zero of points. Rows of bodies of other ranks are not
/// known, but for what is needed here.
class ScaledOperator
{
public:
  explicit ScaledOperator(const SpringNetwork &springs) : network(springs)
  {
    for (const double mass : network.mass)
      over_mass.push_back(1. / std::sqrt(mass));
    for (const double inertia : network.inertia)
      over_inertia.push_back(1. / std::sqrt(inertia));
  }

  Eigen::Index size() const
  {
    return static_cast<Eigen::Index>(6 * network.n_bodies());
  }

  /// x gets the rows of bodies of other ranks. Collective.
  void apply(double dt, Field &x, Field &y) const
  {
    network.sharing->fill({x.data(), static_cast<std::size_t>(x.size())});
    const auto n = static_cast<Eigen::Index>(6 * network.n_particles());
    y.setZero();
    const double own = std::pow(dt * network.point_frequency, 2);
    y.tail(size() - n) = own * x.tail(size() - n);
    for (std::size_t k = 0; k < network.n_contacts(); ++k)
      apply_contact(k, dt, x, y);
  }

  /// Of all ranks, the same bits on any number of them. Collective.
  double product(const Field &x, const Field &y) const
  {
    std::array<ExactSum, 1> sum;
    for (std::size_t body = 0; body < network.n_bodies(); ++body)
      if (network.sharing->is_owned(body))
        sum[0].add(x.segment<6>(moving(body)).dot(y.segment<6>(moving(body))));
    network.sharing->sum(sum);
    return sum[0].value();
  }
  /// However short it is: the sum is exact to a share of its largest term.
  double length(const Field &x) const
  {
    std::array largest{0.};
    for (std::size_t body = 0; body < network.n_bodies(); ++body)
      if (network.sharing->is_owned(body))
        largest[0] = std::max(largest[0],
                              x.segment<6>(moving(body)).cwiseAbs().maxCoeff());
    network.sharing->largest(largest);
    if (largest[0] == 0.)
      return 0.;
    const int exponent = std::ilogb(largest[0]);
    const Field near_one = std::ldexp(1., -exponent) * x;
    return std::ldexp(std::sqrt(product(near_one, near_one)), exponent);
  }

  /// Some of every mode, the same in every run: a multiplicative congruential
  /// generator, to no further purpose.
  Field start_vector() const
  {
    Field x = Field::Zero(size());
    for (std::size_t body = 0; body < network.n_bodies(); ++body)
    {
      auto state = 2 * static_cast<std::uint64_t>(network.name_of(body)) + 1;
      for (Eigen::Index d = 0; d < (turns(body) ? 6 : 3); ++d)
      {
        for (int again = 0; again < 4; ++again)
          state = state * 6364136223846793005u + 1442695040888963407u;
        x[moving(body) + d] =
            static_cast<double>(state >> 11) / 9007199254740992. - 0.5;
      }
    }
    return x;
  }

private:
  static Eigen::Index moving(std::size_t body)
  {
    return static_cast<Eigen::Index>(6 * body);
  }
  static Eigen::Index turning(std::size_t particle)
  {
    return static_cast<Eigen::Index>(6 * particle + 3);
  }
  bool turns(std::size_t body) const { return body < network.n_particles(); }

  void apply_contact(std::size_t k, double dt, const Field &x, Field &y) const
  {
    const auto a = static_cast<std::size_t>(network.a[k]);
    Vec3 turn = over_inertia[a] * x.segment<3>(turning(a));
    Vec3 apart =
        over_mass[a] * x.segment<3>(moving(a)) + turn.cross(network.lever_a[k]);
    for (const FarShare &share : network.b[k])
      if (share.body >= 0)
      {
        const auto b = static_cast<std::size_t>(share.body);
        apart -= share.weight * over_mass[b] * x.segment<3>(moving(b));
        if (turns(b))
        {
          const Vec3 other = over_inertia[b] * x.segment<3>(turning(b));
          apart -= other.cross(network.lever_b[k]);
          turn -= other;
        }
      }
    const Vec3 &n = network.normal[k];
    const double normal = dt * (dt * network.normal_stiffness[k] +
                                2. * network.normal_dashpot[k]),
                 shear = dt * (dt * network.shear_stiffness[k] +
                               2. * network.shear_dashpot[k]);
    const Vec3 force = shear * apart + (normal - shear) * n.dot(apart) * n;
    const Vec3 moment =
        dt * dt * network.rolling_stiffness[k] * (turn - n.dot(turn) * n);
    y.segment<3>(moving(a)) += over_mass[a] * force;
    y.segment<3>(turning(a)) +=
        over_inertia[a] * (network.lever_a[k].cross(force) + moment);
    for (const FarShare &share : network.b[k])
      if (share.body >= 0)
      {
        const auto b = static_cast<std::size_t>(share.body);
        y.segment<3>(moving(b)) -= share.weight * over_mass[b] * force;
        if (turns(b))
          y.segment<3>(turning(b)) -=
              over_inertia[b] * (network.lever_b[k].cross(force) + moment);
      }
  }

  const SpringNetwork &network;
  std::vector<double> over_mass, over_inertia;
};

double largest_of(const std::vector<double> &diagonal,
                  const std::vector<double> &beside)
{
  const auto n = static_cast<Eigen::Index>(diagonal.size());
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(
      Eigen::Map<const Eigen::VectorXd>(diagonal.data(), n),
      Eigen::Map<const Eigen::VectorXd>(beside.data(), n - 1),
      Eigen::EigenvaluesOnly);
  return solver.eigenvalues().maxCoeff();
}

/// Lanczos without orthogonalisation: copies of an eigenvalue do no harm to
/// the largest one. Stops when it stands still to 1e-8 over twice ten steps.
double largest_eigenvalue(const ScaledOperator &matrix, double dt)
{
  constexpr int interval = 10;
  std::vector<double> diagonal, beside;
  Field x = matrix.start_vector(), before = Field::Zero(x.size()),
        image(x.size());
  double length = matrix.length(x), eigenvalue = 0.;
  int n_still = 0;
  for (int step = 0; step < 500; ++step)
  {
    const double coupling = step == 0 ? 0. : length;
    if (step > 0)
      beside.push_back(coupling);
    x /= length;
    matrix.apply(dt, x, image);
    diagonal.push_back(matrix.product(x, image));
    image -= diagonal.back() * x + coupling * before;
    before.swap(x);
    x.swap(image);
    length = matrix.length(x);
    const bool is_exhausted = length <= 1e-14 * diagonal.front();
    if ((step + 1) % interval != 0 && !is_exhausted)
      continue;
    const double last = std::exchange(eigenvalue, largest_of(diagonal, beside));
    n_still = eigenvalue - last <= 1e-8 * eigenvalue ? n_still + 1 : 0;
    if (is_exhausted || n_still == 2)
      break;
  }
  return eigenvalue;
}
} // namespace

double sharp_step(const SpringNetwork &network)
{
  double step = guaranteed_step(network).step;
  if (!std::isfinite(step))
    return step;
  const ScaledOperator matrix(network);
  // log(lambda) over log(dt) has a slope of one (dashpots) to two (springs):
  // a secant, started with two, from the stable side.
  double slope = 2., excess = std::log(largest_eigenvalue(matrix, step) / 4.);
  for (int pass = 0; pass < 20 && std::abs(excess) > 1e-8; ++pass)
  {
    const double move = -excess / slope;
    step *= std::exp(move);
    const double last =
        std::exchange(excess, std::log(largest_eigenvalue(matrix, step) / 4.));
    slope = std::clamp((excess - last) / move, 1., 2.);
  }
  return step;
}
} // namespace dem
