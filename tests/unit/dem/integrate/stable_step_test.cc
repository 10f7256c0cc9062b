#include <dem/integrate/stable_step.h>

#include <gtest/gtest.h>

#include <random>

// The steps of spring networks against dense matrices: nothing of the source
// is used to build them but the columns.
namespace
{
using dem::FarShare;
using dem::SpringNetwork;
using dem::Vec3;

struct Springs
{
  double normal = 0., shear = 0., rolling = 0.;   // [N/m], [N m/rad]
  double normal_dashpot = 0., shear_dashpot = 0.; // [N s/m]
};

void add(SpringNetwork &network, std::int32_t a,
         const std::array<FarShare, 4> &b, const Vec3 &lever_a,
         const Vec3 &lever_b, const Springs &springs)
{
  network.a.push_back(a);
  network.b.push_back(b);
  network.normal.push_back(lever_a.normalized());
  network.lever_a.push_back(lever_a);
  network.lever_b.push_back(lever_b);
  network.normal_stiffness.push_back(springs.normal);
  network.shear_stiffness.push_back(springs.shear);
  network.rolling_stiffness.push_back(springs.rolling);
  network.normal_dashpot.push_back(springs.normal_dashpot);
  network.shear_dashpot.push_back(springs.shear_dashpot);
}

void add_body(SpringNetwork &network, double mass, double radius)
{
  network.mass.push_back(mass);
  network.inertia.push_back(0.4 * mass * radius * radius);
}

using Row = Eigen::RowVectorXd;

/// Relative motion and turning of contact k along a unit vector, as rows over
/// 6 unknowns of every body.
struct Rows
{
  Row motion, turning;
};

Rows rows_of(const SpringNetwork &network, std::size_t k, const Vec3 &e)
{
  const auto n = static_cast<Eigen::Index>(6 * network.n_bodies());
  Rows rows{Row::Zero(n), Row::Zero(n)};
  const auto put = [&](std::int32_t body, double weight, const Vec3 &lever)
  {
    // e . (u + theta x l) = e . u + (l x e) . theta
    rows.motion.segment<3>(6 * body) += weight * e.transpose();
    if (static_cast<std::size_t>(body) >= network.n_particles())
      return;
    rows.motion.segment<3>(6 * body + 3) += weight * lever.cross(e).transpose();
    rows.turning.segment<3>(6 * body + 3) += weight * e.transpose();
  };
  put(network.a[k], 1., network.lever_a[k]);
  for (const FarShare &share : network.b[k])
    if (share.body >= 0)
      put(share.body, -share.weight, network.lever_b[k]);
  return rows;
}

/// Largest eigenvalue of M^-1 (dt^2 K + 2 dt C), dense.
double dense_eigenvalue(const SpringNetwork &network, double dt)
{
  const auto n = static_cast<Eigen::Index>(6 * network.n_bodies());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t k = 0; k < network.n_contacts(); ++k)
  {
    const Vec3 normal = network.normal[k];
    const Vec3 first = normal.unitOrthogonal(), second = normal.cross(first);
    const double along = dt * dt * network.normal_stiffness[k] +
                         2. * dt * network.normal_dashpot[k],
                 across = dt * dt * network.shear_stiffness[k] +
                          2. * dt * network.shear_dashpot[k];
    const Rows at_normal = rows_of(network, k, normal);
    matrix += along * at_normal.motion.transpose() * at_normal.motion;
    for (const Vec3 &e : {first, second})
    {
      const Rows at = rows_of(network, k, e);
      matrix += across * at.motion.transpose() * at.motion;
      matrix += dt * dt * network.rolling_stiffness[k] *
                at.turning.transpose() * at.turning;
    }
  }
  Eigen::VectorXd root = Eigen::VectorXd::Ones(n);
  for (std::size_t i = 0; i < network.n_bodies(); ++i)
  {
    const auto at = static_cast<Eigen::Index>(6 * i);
    root.segment<3>(at).setConstant(1. / std::sqrt(network.mass[i]));
    if (i < network.n_particles())
      root.segment<3>(at + 3).setConstant(1. / std::sqrt(network.inertia[i]));
    else
      matrix.diagonal().segment<3>(at) +=
          std::pow(dt * network.point_frequency, 2) * network.mass[i] *
          Vec3::Ones();
  }
  matrix = root.asDiagonal() * matrix * root.asDiagonal();
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix)
      .eigenvalues()
      .maxCoeff();
}

/// Particles and points at random, each particle with some walls, particles and
/// points.
SpringNetwork random_network(unsigned int seed)
{
  std::mt19937 generator(seed);
  const auto between = [&generator](double low, double high)
  { return std::uniform_real_distribution<double>(low, high)(generator); };
  const auto direction = [&]
  {
    return Vec3(between(-1., 1.), between(-1., 1.), between(-1., 1.))
        .normalized();
  };
  const auto springs = [&]
  {
    Springs s{between(1e4, 1e6), between(0., 1e6), between(0., 1e2)};
    s.normal_dashpot = between(0., 30.);
    s.shear_dashpot = between(0., 30.);
    return s;
  };
  SpringNetwork network;
  const std::int32_t n_particles = 12, n_points = 6;
  for (int i = 0; i < n_particles; ++i)
    add_body(network, between(1e-3, 1e-1), between(5e-3, 2e-2));
  for (int i = 0; i < n_points; ++i)
    network.mass.push_back(between(1e-4, 1e-2));
  network.point_frequency = between(0., 2e4);
  for (std::int32_t i = 0; i < n_particles; ++i)
  {
    const auto lever = [&] { return Vec3(between(5e-3, 2e-2) * direction()); };
    add(network, i, {}, lever(), Vec3::Zero(), springs());
    for (int n = 0; n < 3; ++n)
      if (const auto other =
              static_cast<std::int32_t>(between(0., n_particles));
          other != i)
      {
        const Vec3 l = lever();
        add(network, i, {FarShare{other, 1.}}, l, -between(0.5, 2.) * l,
            springs());
      }
    const auto point =
        static_cast<std::int32_t>(n_particles + between(0., n_points - 1.));
    add(network, i, {FarShare{point, 0.3}, FarShare{point + 1, 0.7}}, lever(),
        Vec3::Zero(), springs());
  }
  return network;
}
} // namespace

// The sharp step is where the dense eigenvalue is 4, and the guaranteed one is
// never beyond it, but not far below either.
TEST(StableStep, AgreesWithDenseMatrices)
{
  for (unsigned int seed = 1; seed <= 20; ++seed)
  {
    const SpringNetwork network = random_network(seed);
    const double sharp = dem::sharp_step(network);
    EXPECT_NEAR(dense_eigenvalue(network, sharp), 4., 1e-6);
    const dem::NetworkStep bound = dem::guaranteed_step(network);
    EXPECT_LE(dense_eigenvalue(network, bound.step), 4.);
    EXPECT_GT(bound.step, 0.5 * sharp); // levers and masses at random
    ASSERT_GE(bound.body, 0);
  }
}

// 1/m + l^2/I = 3.5/m; the rolling spring k_s l^2 makes it 3 + sqrt(6.5).
TEST(StableStep, OneParticleOnOneWallIsExact)
{
  const double mass = 0.01, radius = 0.02, k = 1e6;
  for (const double rolling : {0., 1.})
  {
    SpringNetwork network;
    add_body(network, mass, radius);
    add(network, 0, {}, radius * Vec3::UnitZ(), Vec3::Zero(),
        {0.1 * k, k, rolling * k * radius * radius});
    const double share = rolling > 0. ? 3. + std::sqrt(6.5) : 3.5;
    const double exact = 2. * std::sqrt(mass / (share * k));
    EXPECT_NEAR(dem::guaranteed_step(network).step, exact, 1e-8 * exact);
    EXPECT_NEAR(dem::sharp_step(network), exact, 1e-8 * exact);
  }
}

TEST(StableStep, NormalDashpotTakesItsShare)
{
  const double mass = 0.01, k = 1e6, beta = 0.62;
  SpringNetwork network;
  add_body(network, mass, 0.02);
  add(network, 0, {}, 0.02 * Vec3::UnitZ(), Vec3::Zero(),
      {k, 0., 0., 2. * beta * std::sqrt(k * mass), 0.});
  const double exact =
      2. * std::sqrt(mass / k) * (std::sqrt(1. + beta * beta) - beta);
  EXPECT_NEAR(dem::guaranteed_step(network).step, exact, 1e-8 * exact);
  EXPECT_NEAR(dem::sharp_step(network), exact, 1e-8 * exact);
}

// Two particles of different mass: 3.5 k_s / m*.
TEST(StableStep, TwoParticlesAreExact)
{
  const double m = 0.01, r = 0.02, k = 1e6;
  SpringNetwork network;
  add_body(network, m, r);
  add_body(network, 3. * m, 2. * r);
  add(network, 0, {FarShare{1, 1.}}, r * Vec3::UnitX(), -2. * r * Vec3::UnitX(),
      {k, 0.85 * k});
  const double exact = 2. / std::sqrt(3.5 * 0.85 * k * (4. / 3.) / m);
  EXPECT_NEAR(dem::guaranteed_step(network).step, exact, 1e-8 * exact);
  EXPECT_NEAR(dem::sharp_step(network), exact, 1e-8 * exact);
}

// Several particles on one node add up, which the gain of one contact misses.
TEST(StableStep, ParticlesOnOnePointAddUp)
{
  const double node = 1e-5, k = 1e5;
  SpringNetwork network;
  for (int i = 0; i < 4; ++i)
    add_body(network, 1e3, 0.02);
  network.mass.push_back(node);
  for (std::int32_t i = 0; i < 4; ++i)
    add(network, i, {FarShare{4, 1.}}, 0.02 * Vec3::UnitX(), Vec3::Zero(), {k});
  const double exact = 2. / std::sqrt(4. * k / node);
  // The particles are heavy, not fixed: 1e-8 of the mass.
  EXPECT_NEAR(dem::guaranteed_step(network).step, exact, 1e-6 * exact);
  EXPECT_NEAR(dem::sharp_step(network), exact, 1e-6 * exact);
  EXPECT_EQ(dem::guaranteed_step(network).body, 4);
  EXPECT_EQ(dem::describe_body(network, 4), "membrane node 0 of 0.01 g on 4 "
                                            "particles");
}

TEST(StableStep, NothingTouchesNothingLimits)
{
  SpringNetwork network;
  add_body(network, 0.01, 0.02);
  EXPECT_TRUE(std::isinf(dem::guaranteed_step(network).step));
  EXPECT_TRUE(std::isinf(dem::sharp_step(network)));
  EXPECT_EQ(dem::describe_body(network, -1), "no contacts");
}
