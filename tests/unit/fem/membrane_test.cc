#include "flat_mesh.h"

#include <fem/membrane.h>

#include <gtest/gtest.h>

#include <cstring>
#include <numeric>
#include <sstream>

namespace
{
using Vector = Eigen::Vector3d;
using Field = std::vector<Vector>;

fem::SurfaceMesh small_box()
{
  return fem::box_sides({0., 0., 0.}, {0.1, 0.08, 0.12}, {4, 3, 5});
}

/// Rims tied, the upper one moving, pressure, damping and loads that change.
class BusyMembrane
{
public:
  BusyMembrane() : membrane(parameters(), small_box())
  {
    lower = fem::nodes_at_height(membrane.mesh(), 0., 1e-9);
    upper = fem::nodes_at_height(membrane.mesh(), 0.12, 1e-9);
    membrane.tie(lower);
    membrane.tie(upper);
  }
  void advance(int first, int last)
  {
    for (int step = first; step < last; ++step)
    {
      membrane.set_pressure(200. + step);
      for (const std::int32_t node : upper)
        membrane.set_tied_velocity(
            node, Vector(0., 0., -0.1 * std::sin(0.05 * step)));
      membrane.begin_step(2e-5);
      const auto seed = static_cast<unsigned int>(step);
      membrane.end_step(support::random_vectors(membrane.n_nodes(), 1e-3, seed),
                        2e-5);
    }
  }
  std::string bits() const
  {
    std::ostringstream out;
    membrane.save(out);
    return out.str();
  }

  fem::Membrane membrane;
  std::vector<std::int32_t> lower, upper;

private:
  static fem::MembraneParameters parameters()
  {
    fem::MembraneParameters p;
    p.mass_damping = 20.;
    return p;
  }
};

TEST(Membrane, LumpedMassIsThatOfTheSheet)
{
  const fem::Membrane membrane(fem::MembraneParameters(), small_box());
  const auto mass = membrane.nodal_mass();
  const double area = 2. * (0.1 + 0.08) * 0.12;
  EXPECT_NEAR(std::accumulate(mass.begin(), mass.end(), 0.),
              1100. * 1e-3 * area, 1e-14);
}

TEST(Membrane, PressurePushesInwards)
{
  fem::MembraneParameters light;
  light.youngs_modulus = 1.;
  fem::Membrane membrane(light, small_box());
  membrane.tie(fem::nodes_at_height(membrane.mesh(), 0., 1e-9));
  membrane.set_pressure(1000.);
  // Node 1 lies on the side y = 0 on the lower rim and carries half a quad.
  EXPECT_NEAR(membrane.reaction(1).y(), 1000. * 0.5 * 0.025 * 0.024, 1e-12);
  membrane.begin_step(1e-5);
  EXPECT_LT(membrane.enclosed_volume(), 0.1 * 0.08 * 0.12);
}

// Shifted to where another one was put: the same forces; the works stay.
TEST(Membrane, DisplacedIsAsIfPutThere)
{
  fem::Membrane put(fem::MembraneParameters(), small_box());
  fem::Membrane moved(fem::MembraneParameters(), small_box());
  const auto rim = fem::nodes_at_height(put.mesh(), 0., 1e-9);
  const Field load = support::random_vectors(moved.n_nodes(), 1., 4);
  for (fem::Membrane *membrane : {&put, &moved})
    membrane->tie(rim);
  moved.begin_step(2e-5);
  moved.end_step(load, 2e-5);
  const double work = moved.energy().contact_work;
  const Field there = support::shaken(put.mesh().nodes, 0.003, 2);
  Field shift(there.size());
  for (std::size_t k = 0; k < shift.size(); ++k)
    shift[k] = there[k] - moved.positions()[k];
  put.set_positions(there);
  put.set_load(load);
  moved.displace(shift);
  EXPECT_NEAR(moved.energy().strain, put.energy().strain,
              1e-10 * put.energy().strain);
  EXPECT_LT((moved.reaction(1) - put.reaction(1)).norm(),
            1e-10 * put.reaction(1).norm());
  EXPECT_EQ(moved.energy().contact_work, work);
  shift.pop_back();
  EXPECT_THROW(moved.displace(shift), std::invalid_argument);
}

// Newton's third law and the symmetry of the stress, through velocity Verlet.
TEST(Membrane, FreeFlightKeepsMomentum)
{
  fem::Membrane membrane(fem::MembraneParameters(), small_box());
  Field load = support::random_vectors(membrane.n_nodes(), 1., 4);
  membrane.set_positions(support::shaken(membrane.mesh().nodes, 0.003, 2));
  const auto momenta = [&membrane](double &scale)
  {
    Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
    scale = 0.;
    for (std::size_t k = 0; k < membrane.n_nodes(); ++k)
    {
      const Vector p = membrane.nodal_mass()[k] * membrane.velocities()[k];
      sum.head<3>() += p;
      sum.tail<3>() += membrane.positions()[k].cross(p);
      scale += p.norm();
    }
    return sum;
  };
  membrane.begin_step(2e-5);
  membrane.end_step(load, 2e-5);
  std::fill(load.begin(), load.end(), Vector::Zero());
  membrane.begin_step(2e-5);
  membrane.end_step(load, 2e-5);
  double scale = 0.;
  const auto start = momenta(scale);
  EXPECT_GT(start.norm(), 1e-3 * scale);
  for (int step = 0; step < 2000; ++step)
  {
    membrane.begin_step(2e-5);
    membrane.end_step(load, 2e-5);
  }
  // 2000 steps of round-off of random sign.
  EXPECT_LT((momenta(scale) - start).norm(), 1e-12 * scale);
}

TEST(Membrane, CheckpointContinuesBitForBit)
{
  BusyMembrane unbroken, first, second;
  unbroken.advance(0, 200);
  first.advance(0, 100);
  std::istringstream file(first.bits());
  second.membrane.load(file);
  EXPECT_EQ(second.bits(), first.bits());
  second.advance(100, 200);
  EXPECT_EQ(second.bits(), unbroken.bits());
  const fem::MembraneEnergy a = second.membrane.energy();
  const fem::MembraneEnergy b = unbroken.membrane.energy();
  EXPECT_EQ(std::memcmp(&a, &b, sizeof(a)), 0);
}

TEST(Membrane, CheckpointThatDoesNotFitIsRefused)
{
  BusyMembrane busy;
  busy.advance(0, 3);
  const std::string bits = busy.bits();
  std::istringstream cut(bits.substr(0, bits.size() - 1)), wrong("nonsense"),
      other(bits);
  EXPECT_THROW(busy.membrane.load(cut), std::runtime_error);
  EXPECT_THROW(busy.membrane.load(wrong), std::runtime_error);
  EXPECT_EQ(busy.bits(), bits) << "a failed load must change nothing";
  fem::Membrane stranger(fem::MembraneParameters(), small_box());
  EXPECT_THROW(stranger.load(other), std::runtime_error);
}

TEST(Membrane, ReactionsBalanceTheLoadsAtRest)
{
  // A stretched square carries a load at its middle to its rim.
  const int n = 4;
  fem::MembraneParameters parameters;
  parameters.mass_damping = 200.;
  fem::Membrane membrane(parameters, support::flat_square(0.1, n));
  const auto rim = support::square_rim(n);
  membrane.tie(rim);
  Field stretched = membrane.mesh().nodes;
  for (Vector &node : stretched)
    node *= 1.2;
  membrane.set_positions(stretched);
  Field load(membrane.n_nodes(), Vector::Zero());
  load[12] = Vector(0.1, -0.2, 0.3);
  load[0] = Vector(0., 0.05, 0.);
  for (int step = 0; step < 20000; ++step)
  {
    membrane.begin_step(2e-5);
    membrane.end_step(load, 2e-5);
  }
  Vector sum = Vector::Zero();
  for (const std::int32_t node : rim)
    sum += membrane.reaction(node);
  // After 0.4 s at 100 / s only exp(-40) of the start is left.
  EXPECT_LT((sum - load[12] - load[0]).norm(), 1e-10);
  EXPECT_LT(membrane.unbalanced_force_ratio(), 1e-9);
  EXPECT_THROW(membrane.reaction(12), std::invalid_argument);
}

TEST(Membrane, TiedNodesGoWhereTheyAreTold)
{
  BusyMembrane busy;
  busy.advance(0, 50);
  double height = 0.12;
  for (int step = 0; step < 50; ++step)
    height += 2e-5 * -0.1 * std::sin(0.05 * step);
  const auto upper = static_cast<std::size_t>(busy.upper[2]);
  const auto lower = static_cast<std::size_t>(busy.lower[2]);
  EXPECT_NEAR(busy.membrane.positions()[upper].z(), height, 1e-15);
  EXPECT_EQ(busy.membrane.positions()[lower],
            busy.membrane.mesh().nodes[lower]);
  EXPECT_TRUE(busy.membrane.is_tied(busy.upper[2]));
  EXPECT_FALSE(busy.membrane.is_tied(busy.upper[2] - 14));
}

TEST(Membrane, StrongDampingStaysStable)
{
  fem::MembraneParameters parameters;
  parameters.mass_damping = 1e7; // alpha dt = 200
  fem::Membrane membrane(parameters, small_box());
  membrane.set_positions(support::shaken(membrane.mesh().nodes, 0.003, 2));
  const Field none(membrane.n_nodes(), Vector::Zero());
  const double start = membrane.energy().strain;
  for (int step = 0; step < 500; ++step)
  {
    membrane.begin_step(2e-5);
    membrane.end_step(none, 2e-5);
  }
  const fem::MembraneEnergy energy = membrane.energy();
  EXPECT_LT(energy.strain + energy.kinetic, start);
}

TEST(Membrane, RefusesNonsense)
{
  const auto refuses = [](auto change)
  {
    fem::MembraneParameters p;
    change(p);
    EXPECT_THROW(fem::Membrane(p, small_box()), std::invalid_argument);
  };
  refuses([](auto &p) { p.youngs_modulus = -1.; });
  refuses([](auto &p) { p.poisson_ratio = 0.6; });
  refuses([](auto &p) { p.thickness = 0.; });
  refuses([](auto &p) { p.density = std::nan(""); });
  refuses([](auto &p) { p.mass_damping = -1.; });

  BusyMembrane busy;
  fem::Membrane &membrane = busy.membrane;
  const Field short_field(3, Vector::Zero());
  EXPECT_THROW(membrane.tie({-1}), std::invalid_argument);
  EXPECT_THROW(membrane.tie({1000}), std::invalid_argument);
  EXPECT_THROW(membrane.set_tied_velocity(busy.upper[0] - 14, Vector::Zero()),
               std::invalid_argument);
  EXPECT_THROW(membrane.set_positions(short_field), std::invalid_argument);
  EXPECT_THROW(membrane.set_pressure(std::nan("")), std::invalid_argument);
  EXPECT_THROW(membrane.begin_step(0.), std::invalid_argument);
  EXPECT_THROW(membrane.end_step(short_field, 1e-6), std::invalid_argument);
}

TEST(Membrane, BlowUpIsReported)
{
  fem::Membrane membrane(fem::MembraneParameters(), small_box());
  membrane.set_positions(support::shaken(membrane.mesh().nodes, 0.003, 2));
  const Field none(membrane.n_nodes(), Vector::Zero());
  const auto run = [&]
  {
    for (int step = 0; step < 1000; ++step)
    {
      membrane.begin_step(0.01);
      membrane.end_step(none, 0.01);
    }
  };
  EXPECT_THROW(run(), std::runtime_error);
}

TEST(Membrane, WritesTheDeformedShape)
{
  BusyMembrane busy;
  busy.advance(0, 10);
  std::ostringstream file;
  busy.membrane.write_vtu(file);
  const std::string text = file.str();
  EXPECT_NE(text.find("NumberOfCells=\"70\""), std::string::npos);
  for (const char *name : {"displacement_m", "velocity_m_per_s", "load_N",
                           "area_ratio_1", "tension_N_per_m"})
    EXPECT_NE(text.find(name), std::string::npos) << name;
}
} // namespace
