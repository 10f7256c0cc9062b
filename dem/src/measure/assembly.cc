#include <dem/contact/common_normal.h>
#include <dem/measure/assembly.h>
#include <dem/parallel/distribution.h>
#include <dem/parallel/rank_sums.h>

#include <array>

namespace dem
{
namespace
{
/// From A to B.
Vec3 contact_normal(const ParticleSystem &particles, const ContactBatch &pairs,
                    std::size_t k)
{
  const auto a = static_cast<std::size_t>(pairs.a[k]),
             b = static_cast<std::size_t>(pairs.b[k]);
  if (pairs.layout.has_contact_points)
    return particles.orientation(a) *
           surface_point(particles.shape[a], pairs.side_a.contact_point(k))
               .normal;
  return particles.branch(a, b).normalized();
}

/// Sums over the particles and contacts of all ranks.
struct NetworkSums
{
  ExactSum contact_forces; ///< sum |F| [N]
  ExactSum unbalanced;     ///< sum of |resultant force| on the particles [N]
  std::int64_t n_particles = 0, n_contacts = 0;
  std::int64_t n_without = 0, n_with_one = 0; ///< particles, by contacts

  ContactNetwork network() const;
};

ContactNetwork NetworkSums::network() const
{
  ContactNetwork network;
  network.n_contacts = n_contacts;
  const std::int64_t n_bearing = n_particles - n_with_one - n_without;
  if (n_bearing > 0)
    network.coordination_number =
        static_cast<double>(2 * n_contacts - n_with_one) /
        static_cast<double>(n_bearing);
  if (n_contacts > 0)
    network.mean_force =
        contact_forces.value() / static_cast<double>(n_contacts);
  return network;
}

/// Adds the contacts of this rank, and counts them for each of its particles
/// and ghosts.
std::vector<std::int64_t> count_contacts(const Engine &engine,
                                         NetworkSums &sums)
{
  const ParticleSystem &particles = engine.particles();
  const ContactBatch &pairs = engine.pairs();
  std::vector<std::int64_t> n_of(particles.size(), 0);
  // Several contact points of a pair count as one contact.
  for_each_pair(pairs,
                [&](std::span<const std::int32_t> contacts)
                {
                  Vec3 force = Vec3::Zero();
                  bool is_touching = false;
                  for (const std::int32_t contact : contacts)
                    if (const auto k = static_cast<std::size_t>(contact);
                        pairs.is_touching(k))
                    {
                      is_touching = true;
                      force += pair_force(particles, pairs, k);
                    }
                  if (!is_touching)
                    return;
                  const auto first = static_cast<std::size_t>(contacts.front());
                  ++sums.n_contacts;
                  ++n_of[static_cast<std::size_t>(pairs.a[first])];
                  ++n_of[static_cast<std::size_t>(pairs.b[first])];
                  sums.contact_forces.add(force.norm());
                });
  return n_of;
}

NetworkSums measure(const Engine &engine)
{
  const ParticleSystem &particles = engine.particles();
  NetworkSums sums;
  std::vector<std::int64_t> n_of = count_contacts(engine, sums);
  engine.distribution().exchange().collect(n_of);
  for (std::size_t i = 0; i < particles.n_owned(); ++i)
  {
    sums.n_without += n_of[i] == 0;
    sums.n_with_one += n_of[i] == 1;
    sums.unbalanced.add(particles.load[i].force.norm());
  }
  std::array exact{sums.contact_forces, sums.unbalanced};
  std::array counts{static_cast<std::int64_t>(particles.n_owned()),
                    sums.n_contacts, sums.n_without, sums.n_with_one};
  sum_over_ranks(engine.distribution().ranks(), exact, counts);
  return {exact[0], exact[1], counts[0], counts[1], counts[2], counts[3]};
}
} // namespace

Vec3 pair_force(const ParticleSystem &particles, const ContactBatch &pairs,
                std::size_t k)
{
  const Vec3 normal = contact_normal(particles, pairs, k);
  const Triple<double> shear = pairs.shear[k], dashpot = pairs.dashpot[k];
  return Vec3(shear.x + dashpot.x, shear.y + dashpot.y, shear.z + dashpot.z) -
         pairs.normal_force[k] * normal;
}

ContactNetwork contact_network(const Engine &engine)
{
  return measure(engine).network();
}

double solid_volume(const ParticleSystem &particles, const Ranks &ranks)
{
  std::array<ExactSum, 1> sum;
  for (std::size_t i = 0; i < particles.n_owned(); ++i)
    sum[0].add(particles.shape[i].volume);
  sum_over_ranks(ranks, sum);
  return sum[0].value();
}

double abrasion(const ParticleSystem &particles, const Ranks &ranks)
{
  std::array<ExactSum, 2> sums; // mass now, and before
  for (std::size_t i = 0; i < particles.n_owned(); ++i)
  {
    sums[0].add(particles.solid_mass(i));
    sums[1].add(particles.initial_mass[i]);
  }
  sum_over_ranks(ranks, sums);
  const double now = sums[0].value(), before = sums[1].value();
  return before > 0. ? (before - now) / before : 0.;
}

double unbalanced_force_ratio(const Engine &engine)
{
  const NetworkSums sums = measure(engine);
  const double mean_force = sums.network().mean_force;
  return mean_force > 0.
             ? sums.unbalanced.value() / static_cast<double>(sums.n_particles) /
                   mean_force
             : 0.;
}

Vec3 affine_stiffness(const ParticleSystem &particles,
                      const ContactBatch &pairs, const Ranks &ranks)
{
  std::array<ExactSum, 3> sums;
  for (std::size_t k = 0; k < pairs.size(); ++k)
  {
    if (!pairs.is_touching(k))
      continue;
    const Vec3 branch = particles.branch(static_cast<std::size_t>(pairs.a[k]),
                                         static_cast<std::size_t>(pairs.b[k]));
    const double square = branch.squaredNorm();
    const double normal = pairs.normal_stiffness(k),
                 shear = 1. / pairs.shear_compliance[k];
    const Vec3 n2 = branch.cwiseAbs2() / square;
    for (int d = 0; d < 3; ++d)
      sums[static_cast<std::size_t>(d)].add(
          (normal * n2[d] + shear * (1. - n2[d])) * n2[d] * square);
  }
  sum_over_ranks(ranks, sums);
  return {sums[0].value(), sums[1].value(), sums[2].value()};
}
} // namespace dem
