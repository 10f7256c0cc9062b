#include "quadratic_step.h"

#include <dem/integrate/stable_step.h>

#include <algorithm>
#include <sstream>

namespace dem
{
namespace
{
using Mat6 = Eigen::Matrix<double, 6, 6>;

/// What a unit force at one side of a contact moves: across the plane, along
/// it at most [1/kg].
struct Compliance
{
  double normal = 0., shear = 0.;

  Compliance &operator+=(const Compliance &other)
  {
    normal += other.normal;
    shear += other.shear;
    return *this;
  }
};

/// Of one body, with this weight and lever.
Compliance compliance_of(const SpringNetwork &network, std::size_t k,
                         std::size_t body, double weight, const Vec3 &lever)
{
  const double over_mass = weight * weight / network.mass[body];
  Compliance c{over_mass, over_mass};
  if (body < network.n_stones())
  {
    c.normal +=
        lever.cross(network.normal[k]).squaredNorm() / network.inertia[body];
    c.shear += lever.squaredNorm() / network.inertia[body];
  }
  return c;
}

/// Calls visit(body, compliance) for the bodies of contact k.
template <class Visit>
void visit_sides(const SpringNetwork &network, std::size_t k,
                 const Visit &visit)
{
  const auto a = static_cast<std::size_t>(network.a[k]);
  visit(a, compliance_of(network, k, a, 1., network.lever_a[k]));
  for (const FarShare &share : network.b[k])
    if (share.body >= 0 && share.weight != 0.)
    {
      const auto b = static_cast<std::size_t>(share.body);
      visit(b, compliance_of(network, k, b, share.weight, network.lever_b[k]));
    }
}

/// Of all bodies together.
Compliance compliance(const SpringNetwork &network, std::size_t k)
{
  Compliance sum;
  visit_sides(network, k,
              [&sum](std::size_t, const Compliance &own) { sum += own; });
  return sum;
}

/// The same for turning: sum 1 / I over its stones [1/(kg m^2)].
double turning_compliance(const SpringNetwork &network, std::size_t k)
{
  double sum = 1. / network.inertia[static_cast<std::size_t>(network.a[k])];
  const std::int32_t other = network.b[k][0].body;
  if (other >= 0 && static_cast<std::size_t>(other) < network.n_stones())
    sum += 1. / network.inertia[static_cast<std::size_t>(other)];
  return sum;
}

/// Springs and dashpots of one body over its mass, each contact divided by
/// its share alpha in it [1/s^2], [1/s].
struct Block
{
  Mat6 spring = Mat6::Zero(), dashpot = Mat6::Zero();

  Mat6 at(double dt) const { return dt * dt * spring + 2. * dt * dashpot; }
};

/// Stiffness of a contact across and along its plane, as a matrix.
Mat3 spring_tensor(const Vec3 &n, double normal, double shear)
{
  return shear * Mat3::Identity() + (normal - shear) * n * n.transpose();
}

Mat3 cross_matrix(const Vec3 &v)
{
  Mat3 m;
  m << 0., -v.z(), v.y(), v.z(), 0., -v.x(), -v.y(), v.x(), 0.;
  return m;
}

/// Adds what contact k is to one of its bodies, which has this part `own` in
/// the compliance of `all`.
void add_contact(const SpringNetwork &network, std::size_t k, std::size_t body,
                 const Compliance &own, const Compliance &all, Block &block)
{
  const Vec3 &n = network.normal[k];
  // 1 / (alpha m); a point's weight is in its compliance already.
  const double weight =
      body < network.n_stones() ? 1. / network.mass[body] : own.normal;
  const double normal = weight * all.normal / own.normal,
               shear = weight * all.shear / own.shear;
  const Mat3 spring = spring_tensor(n, normal * network.normal_stiffness[k],
                                    shear * network.shear_stiffness[k]);
  const Mat3 dashpot = spring_tensor(n, normal * network.normal_dashpot[k],
                                     shear * network.shear_dashpot[k]);
  block.spring.topLeftCorner<3, 3>() += spring;
  block.dashpot.topLeftCorner<3, 3>() += dashpot;
  if (body >= network.n_stones())
    return;
  const bool is_a = static_cast<std::size_t>(network.a[k]) == body;
  // d = u - [l] theta, with theta scaled so that its inertia is the mass.
  const double gyration = std::sqrt(network.inertia[body] / network.mass[body]);
  const Mat3 turn =
      -cross_matrix(is_a ? network.lever_a[k] : network.lever_b[k]) / gyration;
  const auto add_turning = [&turn](const Mat3 &tensor, Mat6 &sum)
  {
    sum.topRightCorner<3, 3>() += tensor * turn;
    sum.bottomLeftCorner<3, 3>() += turn.transpose() * tensor;
    sum.bottomRightCorner<3, 3>() += turn.transpose() * tensor * turn;
  };
  add_turning(spring, block.spring);
  add_turning(dashpot, block.dashpot);
  block.spring.bottomRightCorner<3, 3>() +=
      turning_compliance(network, k) * network.rolling_stiffness[k] *
      (Mat3::Identity() - n * n.transpose());
}

/// Largest eigenvalue with its parts in springs and dashpots.
Quadratic top_mode(const Block &block, double dt)
{
  const Eigen::SelfAdjointEigenSolver<Mat6> solver(block.at(dt));
  const Eigen::Matrix<double, 6, 1> mode = solver.eigenvectors().col(5);
  return {mode.dot(block.spring * mode), mode.dot(block.dashpot * mode)};
}

/// Largest step of the block, at most `step`: the parabola of the top mode is
/// never above the eigenvalue, so its root comes down to the limit.
double step_of(const Block &block, double step)
{
  for (int pass = 0; pass < 50; ++pass)
  {
    const Quadratic mode = top_mode(block, step);
    const double next = mode.root();
    if (!(next < step * (1. - 1e-13)))
      return step;
    step = next;
  }
  return step;
}

/// Bounds of the traces of all blocks, so of their eigenvalues: rough, quick.
std::vector<Quadratic> traces(const SpringNetwork &network)
{
  std::vector<Quadratic> trace(network.n_bodies());
  for (std::size_t i = network.n_stones(); i < network.n_bodies(); ++i)
    trace[i].spring = 3. * network.point_frequency * network.point_frequency;
  for (std::size_t k = 0; k < network.n_contacts(); ++k)
  {
    const Compliance all = compliance(network, k);
    const double turning = turning_compliance(network, k);
    visit_sides(
        network, k,
        [&](std::size_t body, const Compliance &)
        {
          // tr(J^T T J) / m over alpha: the normal direction has the
          // compliance own.normal, the two of the plane together no more than
          // twice own.shear; alpha is their share in `all`.
          trace[body].spring += all.normal * network.normal_stiffness[k] +
                                2. * all.shear * network.shear_stiffness[k];
          trace[body].dashpot += all.normal * network.normal_dashpot[k] +
                                 2. * all.shear * network.shear_dashpot[k];
          if (body < network.n_stones())
            trace[body].spring += 2. * turning * network.rolling_stiffness[k];
        });
  }
  return trace;
}

/// Springs that a body has besides its contacts.
Block own_block(const SpringNetwork &network, std::size_t body)
{
  Block block;
  if (body >= network.n_stones())
    block.spring.topLeftCorner<3, 3>() =
        network.point_frequency * network.point_frequency * Mat3::Identity();
  return block;
}
} // namespace

namespace
{
/// Blocks of these bodies.
std::vector<Block> blocks_of(const SpringNetwork &network,
                             const std::vector<std::size_t> &bodies)
{
  std::vector<std::int32_t> row(network.n_bodies(), -1);
  std::vector<Block> block;
  for (const std::size_t body : bodies)
  {
    row[body] = static_cast<std::int32_t>(block.size());
    block.push_back(own_block(network, body));
  }
  for (std::size_t k = 0; k < network.n_contacts(); ++k)
  {
    const auto is_asked = [&](std::int32_t body)
    { return body >= 0 && row[static_cast<std::size_t>(body)] >= 0; };
    if (!is_asked(network.a[k]) &&
        std::none_of(network.b[k].begin(), network.b[k].end(),
                     [&](const FarShare &share)
                     { return is_asked(share.body); }))
      continue;
    const Compliance all = compliance(network, k);
    visit_sides(network, k,
                [&](std::size_t body, const Compliance &own)
                {
                  if (row[body] >= 0)
                    add_contact(network, k, body, own, all,
                                block[static_cast<std::size_t>(row[body])]);
                });
  }
  return block;
}
} // namespace

NetworkStep guaranteed_step(const SpringNetwork &network)
{
  const std::vector<Quadratic> trace = traces(network);
  // The body with the largest trace first: it sets the limit, or nearly so.
  std::size_t first = 0;
  double rough = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < trace.size(); ++i)
    if (const double step = trace[i].root(); step < rough)
    {
      rough = step;
      first = i;
    }
  NetworkStep limit;
  if (std::isinf(rough))
    return limit;
  // A sixth of a trace is no more than its largest eigenvalue, and the sums
  // are at most twice the traces: root(trace / 12) is not below the limit.
  limit = {
      step_of(blocks_of(network, {first}).front(),
              Quadratic{trace[first].spring / 12., trace[first].dashpot / 12.}
                  .root()),
      static_cast<std::int32_t>(first)};
  // Then those whose trace says that they may lower it.
  std::vector<std::size_t> others;
  for (std::size_t i = 0; i < trace.size(); ++i)
    if (i != first && trace[i].at(limit.step) > 4.)
      others.push_back(i);
  const std::vector<Block> block = blocks_of(network, others);
  for (std::size_t r = 0; r < others.size(); ++r)
    if (trace[others[r]].at(limit.step) > 4.)
      if (const double step = step_of(block[r], limit.step); step < limit.step)
        limit = {step, static_cast<std::int32_t>(others[r])};
  limit.step *= 1. - 1e-9; // what the iteration may have left above
  return limit;
}

std::string describe_body(const SpringNetwork &network, std::int32_t body)
{
  if (body < 0)
    return "no contacts";
  int n_walls = 0, n_stones = 0, n_surface = 0;
  const auto n = static_cast<std::int32_t>(network.n_stones());
  for (std::size_t k = 0; k < network.n_contacts(); ++k)
  {
    const std::int32_t other = network.b[k][0].body;
    bool is_here = false;
    visit_sides(network, k,
                [&](std::size_t i, const Compliance &)
                { is_here |= i == static_cast<std::size_t>(body); });
    if (is_here)
      ++(other < 0 ? n_walls : other < n ? n_stones : n_surface);
  }
  std::ostringstream text;
  text.precision(3);
  text << (body < n ? "stone " : "membrane node ")
       << (body < n ? body : body - n) << " of "
       << 1e3 * network.mass[static_cast<std::size_t>(body)] << " g on ";
  if (body >= n)
    text << n_surface << " stones";
  else
    text << n_walls << " walls, " << n_stones << " stones, " << n_surface
         << " membrane contacts";
  return text.str();
}
} // namespace dem
