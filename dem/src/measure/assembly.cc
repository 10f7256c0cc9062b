#include <dem/measure/assembly.h>
#include <dem/shape/measures.h>

#include <map>

namespace dem
{
ContactNetwork contact_network(const ContactBatch &pairs, std::size_t n_stones)
{
  std::vector<int> n_of(n_stones, 0);
  ContactNetwork network;
  double sum = 0.;
  for (std::size_t k = 0; k < pairs.size(); ++k)
  {
    if (!pairs.is_touching(k))
      continue;
    ++network.n_contacts;
    ++n_of[static_cast<std::size_t>(pairs.a[k])];
    ++n_of[static_cast<std::size_t>(pairs.b[k])];
    sum += pairs.load[k].force.norm();
  }
  std::int64_t n_without = 0, n_with_one = 0;
  for (const int n : n_of)
  {
    n_without += n == 0;
    n_with_one += n == 1;
  }
  const auto n_bearing =
      static_cast<std::int64_t>(n_stones) - n_with_one - n_without;
  if (n_bearing > 0)
    network.coordination_number =
        static_cast<double>(2 * network.n_contacts - n_with_one) /
        static_cast<double>(n_bearing);
  if (network.n_contacts > 0)
    network.mean_force = sum / static_cast<double>(network.n_contacts);
  return network;
}

double abrasion(const Particles &particles)
{
  double now = 0., before = 0.;
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    now += particles.mass[i];
    before += particles.initial_mass[i];
  }
  return before > 0. ? (before - now) / before : 0.;
}

double unbalanced_force_ratio(const Particles &particles,
                              const ContactBatch &pairs)
{
  const double mean_force = contact_network(pairs, particles.size()).mean_force;
  double sum = 0.;
  for (const Vec3 &force : particles.force)
    sum += force.norm();
  return mean_force > 0.
             ? sum / static_cast<double>(particles.size()) / mean_force
             : 0.;
}

Vec3 affine_stiffness(const Particles &particles, const ContactBatch &pairs)
{
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < pairs.size(); ++k)
  {
    if (!pairs.is_touching(k))
      continue;
    const ContactHistory &history = pairs.history[k];
    const double length =
        (particles.position[static_cast<std::size_t>(pairs.b[k])] -
         particles.position[static_cast<std::size_t>(pairs.a[k])])
            .norm();
    const double normal = 1.5 * history.normal_force / history.overlap;
    const Vec3 n2 = pairs.normal[k].cwiseAbs2();
    for (int d = 0; d < 3; ++d)
      sum[d] += (normal * n2[d] + history.shear_stiffness * (1. - n2[d])) *
                n2[d] * length * length;
  }
  return sum;
}

double mean_roundness(const Particles &particles)
{
  // Unbroken stones of one shape have one roundness, whatever their scale.
  std::map<const Coefficients *, double> known;
  double sum = 0., weight = 0.;
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    const Body &body = particles.body[i];
    if (!body.series)
      continue;
    const auto [entry, is_new] = known.try_emplace(body.series.get(), 0.);
    if (is_new)
      entry->second = roundness(*body.series, standard_quadrature());
    sum += body.volume * entry->second;
    weight += body.volume;
  }
  return weight > 0. ? sum / weight : 1.;
}
} // namespace dem
