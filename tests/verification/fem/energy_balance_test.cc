#include "flat_mesh.h"
#include "relax.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
struct Balance
{
  double error = 0.; ///< largest change of the balance [J]
  double scale = 0.; ///< largest sum of the sizes of its terms [J]
};

double balance(const fem::MembraneEnergy &e)
{
  return e.strain + e.kinetic - e.pressure_work - e.contact_work + e.damping -
         e.tie_work;
}

double size(const fem::MembraneEnergy &e)
{
  return e.strain + e.kinetic + std::abs(e.pressure_work) +
         std::abs(e.contact_work) + e.damping + std::abs(e.tie_work);
}

/// A stretched box under pressure, its lid moving, springs with dashpots
/// against some nodes: all terms of the balance at work.
class Vibration
{
public:
  Vibration()
      : membrane(parameters(),
                 fem::box_sides({0., 0., 0.}, {0.1, 0.1, 0.1}, {6, 6, 6})),
        lid(fem::nodes_at_height(membrane.mesh(), 0.1, 1e-9))
  {
    membrane.tie(lid);
    membrane.tie(fem::nodes_at_height(membrane.mesh(), 0., 1e-9));
    std::vector<Eigen::Vector3d> start = membrane.mesh().nodes;
    for (Eigen::Vector3d &x : start)
      x.z() *= 1.1;
    membrane.set_positions(start);
    membrane.set_pressure(300.);
  }

  Balance run(double time_step)
  {
    support::Loads loads(membrane.n_nodes(), Eigen::Vector3d::Zero());
    const double start = balance(membrane.energy());
    Balance worst;
    for (int step = 0; step * time_step < 0.04; ++step)
    {
      // The velocity in the middle of the step, as the engine sets it.
      const double speed = 0.5 * std::sin(300. * (step + 0.5) * time_step);
      for (const std::int32_t node : lid)
        membrane.set_tied_velocity(node, {0.2 * speed, 0., speed});
      membrane.begin_step(time_step);
      touch(loads);
      membrane.end_step(loads, time_step);
      const fem::MembraneEnergy energy = membrane.energy();
      worst.error = std::max(worst.error, std::abs(balance(energy) - start));
      worst.scale = std::max(worst.scale, size(energy));
    }
    return worst;
  }

private:
  static fem::MembraneParameters parameters()
  {
    fem::MembraneParameters p;
    p.mass_damping = 10.;
    return p;
  }
  void touch(support::Loads &loads) const
  {
    for (std::size_t k = 0; k < loads.size(); k += 5)
    {
      Eigen::Vector3d offset = membrane.positions()[k];
      offset -= membrane.mesh().nodes[k];
      loads[k] = -500. * offset - 0.01 * membrane.velocities()[k];
    }
  }

  fem::Membrane membrane;
  std::vector<std::int32_t> lid;
};

// The balance of velocity Verlet with trapezoidal works: its error falls with
// the square of the step.
TEST(VibratingMembrane, EnergyBalanceClosesToSecondOrder)
{
  Balance last;
  for (const double time_step : {4e-5, 2e-5, 1e-5})
  {
    const Balance now = Vibration().run(time_step);
    std::printf("dt %g s: error %.3e J of %.3e J\n", time_step, now.error,
                now.scale);
    EXPECT_LT(now.error, 1e-3 * now.scale);
    if (last.error > 0.)
    {
      // Two, but for the next order and for where the maximum is sampled.
      EXPECT_NEAR(std::log2(last.error / now.error), 2., 0.15);
    }
    last = now;
  }
}

// One cycle of damped motion: what pressure and start brought is dissipated.
TEST(VibratingMembrane, AllIsDissipatedInTheEnd)
{
  fem::MembraneParameters p;
  p.mass_damping = 300.;
  fem::Membrane membrane(p, support::flat_square(0.1, 6));
  membrane.tie(support::square_rim(6));
  std::vector<Eigen::Vector3d> start = membrane.mesh().nodes;
  for (Eigen::Vector3d &x : start)
    x *= 1.1;
  membrane.set_positions(start);
  const double before = membrane.energy().strain;
  membrane.set_pressure(1000.);
  support::advance(membrane, {2e-5, 0.3});
  const fem::MembraneEnergy e = membrane.energy();
  EXPECT_LT(e.kinetic, 1e-9 * e.pressure_work);
  // Second order: (omega dt)^2 / 8 of the sudden start of the slow mode.
  EXPECT_NEAR(e.damping, before + e.pressure_work - e.strain, 1e-3 * e.damping);
}
} // namespace
