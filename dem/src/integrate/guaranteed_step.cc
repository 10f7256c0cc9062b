#include "quadratic_step.h"

#include <dem/integrate/stable_step.h>

#include <algorithm>
#include <array>
#include <sstream>

namespace dem
{
namespace
{
using Mat6 = Eigen::Matrix<double, 6, 6>;

/// Calls visit(body, |w|, lever) for the bodies of contact k.
template <class Visit>
void visit_sides(const SpringNetwork &network, std::size_t k,
                 const Visit &visit)
{
  visit(static_cast<std::size_t>(network.a[k]), 1., network.lever_a[k]);
  for (const FarShare &share : network.b[k])
    if (share.body >= 0 && share.weight != 0.)
      visit(static_cast<std::size_t>(share.body), std::abs(share.weight),
            network.lever_b[k]);
}

/// Trace of the springs and dashpots of contact k over one of its bodies
/// alone, of weight 1: at most, since a lever counts as across the plane.
Quadratic trace_over(const SpringNetwork &network, std::size_t k,
                     std::size_t body, const Vec3 &lever)
{
  double along = 1. / network.mass[body], across = along;
  if (body < network.n_particles())
  {
    along +=
        lever.cross(network.normal[k]).squaredNorm() / network.inertia[body];
    across += lever.squaredNorm() / network.inertia[body];
  }
  return {along * network.normal_stiffness[k] +
              2. * across * network.shear_stiffness[k],
          along * network.normal_dashpot[k] +
              2. * across * network.shear_dashpot[k]};
}

/// One body of one contact, flat.
struct Side
{
  std::size_t body = 0;
  double weight = 0.;   ///< |w| [-]
  double strength = 0.; ///< trace over the body at some step [-]
};

double least_of_ranks(const SpringNetwork &network, double own)
{
  std::array largest{-own};
  network.sharing->largest(largest);
  return -largest[0];
}

/// Least root over the bodies of all ranks.
double least_root(const SpringNetwork &network,
                  const std::vector<Quadratic> &bodies)
{
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (network.sharing->is_owned(i))
      least = std::min(least, bodies[i].root());
  return least_of_ranks(network, least);
}

/// Amplitudes y of all bodies that share out the contacts: of contact k body i
/// has alpha = |w_i| y_i / sum_j |w_j| y_j. Any y > 0 gives a bound; these are
/// some steps towards the largest mode of the matrix of sizes.
std::vector<double> amplitudes(const SpringNetwork &network)
{
  std::vector<Quadratic> alone(network.n_bodies());
  for (std::size_t k = 0; k < network.n_contacts(); ++k)
    visit_sides(network, k,
                [&](std::size_t body, double weight, const Vec3 &lever)
                {
                  const Quadratic own = trace_over(network, k, body, lever);
                  alone[body].spring += weight * own.spring;
                  alone[body].dashpot += weight * own.dashpot;
                });
  const double step = least_root(network, alone);
  std::vector<double> y(network.n_bodies(), 1.), next(y.size());
  if (std::isinf(step))
    return y;
  std::vector<Side> sides;
  std::vector<std::size_t> first{0};
  for (std::size_t k = 0; k < network.n_contacts(); ++k)
  {
    visit_sides(
        network, k,
        [&](std::size_t body, double weight, const Vec3 &lever)
        {
          sides.push_back(
              {body, weight, trace_over(network, k, body, lever).at(step)});
        });
    first.push_back(sides.size());
  }
  constexpr int n_steps = 6;
  for (int pass = 0; pass < n_steps; ++pass)
  {
    std::fill(next.begin(), next.end(), 0.);
    for (std::size_t k = 0; k + 1 < first.size(); ++k)
    {
      double sum = 0.;
      for (std::size_t s = first[k]; s < first[k + 1]; ++s)
        sum += sides[s].weight * y[sides[s].body];
      for (std::size_t s = first[k]; s < first[k + 1]; ++s)
        next[sides[s].body] += sides[s].weight * sides[s].strength * sum;
    }
    // A body that nothing holds keeps some amplitude: it divides.
    for (std::size_t i = 0; i < y.size(); ++i)
      y[i] = std::max(next[i], 1e-30);
    network.sharing->fill(y);
  }
  return y;
}

/// sum |w| y of contact k.
double amplitude_of(const SpringNetwork &network, std::size_t k,
                    const std::vector<double> &y)
{
  double sum = 0.;
  visit_sides(network, k,
              [&](std::size_t body, double weight, const Vec3 &)
              { sum += weight * y[body]; });
  return sum;
}

/// sum 1 / I over the particles of contact k [1/(kg m^2)].
double turning_compliance(const SpringNetwork &network, std::size_t k)
{
  double sum = 1. / network.inertia[static_cast<std::size_t>(network.a[k])];
  const std::int32_t other = network.b[k][0].body;
  if (other >= 0 && static_cast<std::size_t>(other) < network.n_particles())
    sum += 1. / network.inertia[static_cast<std::size_t>(other)];
  return sum;
}

/// Springs and dashpots of one body over its mass, each contact with the
/// body's w^2 / alpha in it [1/s^2], [1/s].
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

/// Adds what contact k is to one of its bodies; `share` is w^2 / alpha.
void add_contact(const SpringNetwork &network, std::size_t k, std::size_t body,
                 double share, Block &block)
{
  const Vec3 &n = network.normal[k];
  const double weight = share / network.mass[body];
  const Mat3 spring = spring_tensor(n, weight * network.normal_stiffness[k],
                                    weight * network.shear_stiffness[k]);
  const Mat3 dashpot = spring_tensor(n, weight * network.normal_dashpot[k],
                                     weight * network.shear_dashpot[k]);
  block.spring.topLeftCorner<3, 3>() += spring;
  block.dashpot.topLeftCorner<3, 3>() += dashpot;
  if (body >= network.n_particles())
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
  // Most blocks allow it, which is quicker to see than their modes.
  const Mat6 room = 4. * Mat6::Identity() - block.at(step);
  if (Eigen::LLT<Mat6>(room).info() == Eigen::Success)
    return step;
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
std::vector<Quadratic> traces(const SpringNetwork &network,
                              const std::vector<double> &y)
{
  std::vector<Quadratic> trace(network.n_bodies());
  for (std::size_t i = network.n_particles(); i < network.n_bodies(); ++i)
    trace[i].spring = 3. * network.point_frequency * network.point_frequency;
  for (std::size_t k = 0; k < network.n_contacts(); ++k)
  {
    const double sum = amplitude_of(network, k, y);
    const double rolling =
        2. * turning_compliance(network, k) * network.rolling_stiffness[k];
    visit_sides(network, k,
                [&](std::size_t body, double weight, const Vec3 &lever)
                {
                  const double share = weight * sum / y[body];
                  const Quadratic own = trace_over(network, k, body, lever);
                  trace[body].spring += share * own.spring;
                  trace[body].dashpot += share * own.dashpot;
                  if (body < network.n_particles())
                    trace[body].spring += rolling;
                });
  }
  return trace;
}

/// Springs that a body has besides its contacts.
Block own_block(const SpringNetwork &network, std::size_t body)
{
  Block block;
  if (body >= network.n_particles())
    block.spring.topLeftCorner<3, 3>() =
        network.point_frequency * network.point_frequency * Mat3::Identity();
  return block;
}
} // namespace

namespace
{
/// Blocks of these bodies.
std::vector<Block> blocks_of(const SpringNetwork &network,
                             const std::vector<double> &y,
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
    const double sum = amplitude_of(network, k, y);
    visit_sides(network, k,
                [&](std::size_t body, double weight, const Vec3 &)
                {
                  if (row[body] >= 0)
                    add_contact(network, k, body, weight * sum / y[body],
                                block[static_cast<std::size_t>(row[body])]);
                });
  }
  return block;
}
} // namespace

namespace
{
/// The shortest step of all ranks; of equal ones that of the lowest name.
NetworkStep shortest_of_ranks(const SpringNetwork &network,
                              const NetworkStep &own)
{
  const double step = least_of_ranks(network, own.step);
  const double name = own.step == step
                          ? static_cast<double>(own.body)
                          : std::numeric_limits<double>::infinity();
  return {step, static_cast<std::int64_t>(least_of_ranks(network, name))};
}

bool is_shorter(const NetworkStep &one, const NetworkStep &other)
{
  return one.step < other.step ||
         (one.step == other.step && one.body < other.body);
}

/// The body with the least root of its trace, and this root, of all ranks.
NetworkStep first_by_trace(const SpringNetwork &network,
                           const std::vector<Quadratic> &trace)
{
  NetworkStep first;
  for (std::size_t i = 0; i < trace.size(); ++i)
    if (network.sharing->is_owned(i))
      if (const NetworkStep body{trace[i].root(), network.name_of(i)};
          first.body < 0 || is_shorter(body, first))
        first = body;
  return shortest_of_ranks(network, first);
}

/// The bodies of this rank whose blocks are looked at.
struct Candidates
{
  std::vector<std::size_t> bodies;
  double start = 0.; ///< step that the search comes down from [s]
};

/// The shortest step of their blocks, of all ranks. Every search begins at the
/// same step: its result depends on the body alone.
NetworkStep step_of_blocks(const SpringNetwork &network,
                           const std::vector<double> &y,
                           const Candidates &candidates,
                           const NetworkStep &known)
{
  NetworkStep limit = known;
  const std::vector<Block> block = blocks_of(network, y, candidates.bodies);
  for (std::size_t r = 0; r < block.size(); ++r)
    if (const NetworkStep body{step_of(block[r], candidates.start),
                               network.name_of(candidates.bodies[r])};
        is_shorter(body, limit))
      limit = body;
  return shortest_of_ranks(network, limit);
}

/// The bound of these amplitudes.
NetworkStep step_with(const SpringNetwork &network,
                      const std::vector<double> &y)
{
  const std::vector<Quadratic> trace = traces(network, y);
  // The body with the largest trace first: it sets the limit, or nearly so.
  const NetworkStep first = first_by_trace(network, trace);
  if (std::isinf(first.step))
    return {};
  Candidates one, others;
  for (std::size_t i = 0; i < trace.size(); ++i)
    if (network.sharing->is_owned(i) && network.name_of(i) == first.body)
    {
      one.bodies.push_back(i);
      // A sixth of a trace is no more than its largest eigenvalue, and the sums
      // are at most twice the traces: root(trace / 12) is not below the limit.
      one.start =
          Quadratic{trace[i].spring / 12., trace[i].dashpot / 12.}.root();
    }
  NetworkStep limit = step_of_blocks(network, y, one, {});
  // Then those that may lower it, by their trace.
  others.start = limit.step;
  for (std::size_t i = 0; i < trace.size(); ++i)
    if (network.sharing->is_owned(i) && network.name_of(i) != first.body &&
        trace[i].at(limit.step) > 4.)
      others.bodies.push_back(i);
  limit = step_of_blocks(network, y, others, limit);
  limit.step *= 1. - 1e-9; // what the iteration may have left above
  return limit;
}
} // namespace

NetworkStep guaranteed_step(const SpringNetwork &network)
{
  // Both are bounds. Shares by mass suit particles of like load, those of the
  // mode suit light nodes between particles.
  std::vector<double> over_mass;
  for (const double mass : network.mass)
    over_mass.push_back(1. / mass);
  const NetworkStep by_mass = step_with(network, over_mass),
                    by_mode = step_with(network, amplitudes(network));
  return by_mass.step > by_mode.step ? by_mass : by_mode;
}

std::int64_t SpringNetwork::name_of(std::size_t body) const
{
  if (body >= n_particles())
    return first_point_name() + static_cast<std::int64_t>(body - n_particles());
  return id.empty() ? static_cast<std::int64_t>(body) : id[body];
}

std::int64_t total_contacts(const SpringNetwork &network)
{
  std::array<ExactSum, 1> n;
  for (const std::int32_t a : network.a)
    n[0].add(network.sharing->is_owned(static_cast<std::size_t>(a)) ? 1. : 0.);
  network.sharing->sum(n);
  return static_cast<std::int64_t>(n[0].value());
}

namespace
{
/// What a body touches.
struct Neighbours
{
  double mass = 0.; ///< of the body [kg]
  int n_walls = 0, n_particles = 0, n_surface = 0;
};

/// Of a body that some rank owns.
Neighbours neighbours_of(const SpringNetwork &network, std::int64_t name)
{
  Neighbours found;
  for (std::size_t body = 0; body < network.n_bodies(); ++body)
  {
    if (!network.sharing->is_owned(body) || network.name_of(body) != name)
      continue;
    found.mass = network.mass[body];
    for (std::size_t k = 0; k < network.n_contacts(); ++k)
    {
      const std::int32_t other = network.b[k][0].body;
      bool is_here = false;
      visit_sides(network, k,
                  [&](std::size_t i, double, const Vec3 &)
                  { is_here |= i == body; });
      if (is_here)
        ++(other < 0 ? found.n_walls
           : static_cast<std::size_t>(other) < network.n_particles()
               ? found.n_particles
               : found.n_surface);
    }
  }
  std::array numbers{found.mass, static_cast<double>(found.n_walls),
                     static_cast<double>(found.n_particles),
                     static_cast<double>(found.n_surface)};
  network.sharing->largest(numbers);
  return {numbers[0], static_cast<int>(numbers[1]),
          static_cast<int>(numbers[2]), static_cast<int>(numbers[3])};
}
} // namespace

std::string describe_body(const SpringNetwork &network, std::int64_t name)
{
  if (name < 0)
    return "no contacts";
  const Neighbours at = neighbours_of(network, name);
  const std::int64_t first = network.first_point_name();
  std::ostringstream text;
  text.precision(3);
  text << (name < first ? "particle " : "membrane node ")
       << (name < first ? name : name - first) << " of " << 1e3 * at.mass
       << " g on ";
  if (name >= first)
    text << at.n_surface << " particles";
  else
    text << at.n_walls << " walls, " << at.n_particles << " particles, "
         << at.n_surface << " membrane contacts";
  return text.str();
}
} // namespace dem
