#include <coupling/exchange.h>
#include <dem/measure/contact_springs.h>
#include <dem/parallel/distribution.h>
#include <dem/parallel/rank_sums.h>

#include <algorithm>
#include <limits>
#include <utility>

// How stiff the contacts are that an exchange has, for gains and steps.
namespace coupling
{
double Exchange::gain(const dem::Engine &engine, double window) const
{
  double largest = 0.;
  for (const CoupledBody &coupled : coupled_bodies)
  {
    std::vector<dem::ExactSum> sums(coupled.at.size());
    coupled.adapter->add_stiffness(engine, sums);
    dem::sum_over_ranks(engine.distribution().ranks(), sums);
    std::vector<double> stiffness;
    for (const dem::ExactSum &sum : sums)
      stiffness.push_back(sum.value());
    largest = std::max(largest, coupled.body->squared_frequency(stiffness));
  }
  return 0.25 * window * window * largest;
}

void Exchange::limit_windows(int particle_steps, double limit_of_gain)
{
  length.cap(particle_steps);
  gain_limit = limit_of_gain;
}

dem::SpringNetwork Exchange::springs(const dem::Engine &engine,
                                     double horizon) const
{
  dem::SpringNetwork network = dem::contact_springs(engine, horizon);
  std::vector<SurfacePoints> surfaces;
  for (const CoupledBody &coupled : coupled_bodies)
    if (const InterfaceMap *map = coupled.adapter->facets())
    {
      std::vector<double> mass = coupled.body->nodal_mass();
      mass.resize(map->n_nodes());
      if (parameters.rule != ExchangeRule::every_step)
        mass.assign(mass.size(), std::numeric_limits<double>::infinity());
      surfaces.push_back({map, std::move(mass)});
    }
  refer_to_nodes(surfaces, network);
  return network;
}
} // namespace coupling
