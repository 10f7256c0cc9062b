#include <coupling/membrane_driver.h>
#include <dem/integrate/contact_springs.h>

#include <algorithm>
#include <chrono>

namespace coupling
{
namespace
{
/// Runs `work` and adds its wall-clock to a phase.
template <class Work>
void timed(double &phase, const Work &work)
{
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  work();
  phase += std::chrono::duration<double>(Clock::now() - start).count();
}

std::vector<std::int32_t> rim(const fem::SurfaceMesh &mesh, bool is_upper)
{
  const auto [low, high] = std::minmax_element(
      mesh.nodes.begin(), mesh.nodes.end(),
      [](const auto &a, const auto &b) { return a.z() < b.z(); });
  return fem::nodes_at_height(mesh, is_upper ? high->z() : low->z(),
                              1e-6 * (high->z() - low->z()));
}
} // namespace

MembraneDriver::MembraneDriver(const fem::MembraneParameters &parameters,
                               const fem::SurfaceMesh &mesh,
                               dem::Engine &engine)
    : membrane(parameters, mesh), map(membrane), upper_rim(rim(mesh, true)),
      nodal_load(mesh.nodes.size(), Eigen::Vector3d::Zero())
{
  membrane.tie(rim(mesh, false));
  membrane.tie(upper_rim);
  engine.attach_surface(map.make_surface(membrane));
}

void MembraneDriver::begin_step(dem::Engine &engine, double rim_speed,
                                double time_step)
{
  timed(spent.membrane,
        [&]
        {
          for (const std::int32_t node : upper_rim)
            membrane.set_tied_velocity(node, {0., 0., rim_speed});
          membrane.begin_step(time_step);
        });
  timed(spent.transfer, [&] { map.send_motion(membrane, engine.surface()); });
}

void MembraneDriver::end_step(const dem::Engine &engine, double time_step)
{
  timed(spent.transfer,
        [&]
        {
          map.collect_load(engine.surface(), nodal_load);
          last_balance = check_balance(engine.surface(), membrane, nodal_load);
        });
  timed(spent.membrane, [&] { membrane.end_step(nodal_load, time_step); });
}

double MembraneDriver::rim_reaction() const
{
  double sum = 0.;
  for (const std::int32_t node : upper_rim)
    sum += membrane.reaction(node).z();
  return sum;
}

double MembraneDriver::rim_mass() const
{
  double sum = 0.;
  for (const std::int32_t node : upper_rim)
    sum += membrane.nodal_mass()[static_cast<std::size_t>(node)];
  return sum;
}

ExchangeGain MembraneDriver::gain(const dem::Engine &engine,
                                  double time_step) const
{
  std::vector<double> free_mass;
  for (std::size_t node = 0; node < membrane.n_nodes(); ++node)
    if (!membrane.is_tied(static_cast<std::int32_t>(node)))
      free_mass.push_back(membrane.nodal_mass()[node]);
  const dem::WallMaterial &contact = engine.parameters().surface;
  return exchange_gain({contact.normal_stiffness, contact.normal_damping,
                        engine.particles().smallest_mass()},
                       free_mass, membrane.stable_time_step(), time_step);
}

dem::SpringNetwork MembraneDriver::springs(const dem::Engine &engine,
                                           double horizon) const
{
  dem::SpringNetwork springs = dem::contact_springs(engine, horizon);
  map.refer_to_nodes(membrane, springs);
  return springs;
}

void MembraneDriver::save(std::ostream &out) const
{
  membrane.save(out);
}

void MembraneDriver::restore(std::istream &in)
{
  membrane.load(in);
}
} // namespace coupling
