#include <dem/contact/common_normal.h>
#include <dem/measure/assembly.h>
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
} // namespace

Vec3 pair_force(const ParticleSystem &particles, const ContactBatch &pairs,
                std::size_t k)
{
  const Vec3 normal = contact_normal(particles, pairs, k);
  const Triple<double> shear = pairs.shear[k], dashpot = pairs.dashpot[k];
  return Vec3(shear.x + dashpot.x, shear.y + dashpot.y, shear.z + dashpot.z) -
         pairs.normal_force[k] * normal;
}

ContactNetwork contact_network(const ParticleSystem &particles,
                               const ContactBatch &pairs)
{
  std::vector<int> n_of(particles.size(), 0);
  ContactNetwork network;
  double sum = 0.;
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
                  ++network.n_contacts;
                  ++n_of[static_cast<std::size_t>(pairs.a[first])];
                  ++n_of[static_cast<std::size_t>(pairs.b[first])];
                  sum += force.norm();
                });
  std::int64_t n_without = 0, n_with_one = 0;
  for (const int n : n_of)
  {
    n_without += n == 0;
    n_with_one += n == 1;
  }
  const auto n_bearing =
      static_cast<std::int64_t>(particles.size()) - n_with_one - n_without;
  if (n_bearing > 0)
    network.coordination_number =
        static_cast<double>(2 * network.n_contacts - n_with_one) /
        static_cast<double>(n_bearing);
  if (network.n_contacts > 0)
    network.mean_force = sum / static_cast<double>(network.n_contacts);
  return network;
}

double solid_volume(const ParticleSystem &particles)
{
  double sum = 0.;
  for (const ParticleShape &body : particles.shape)
    sum += body.volume;
  return sum;
}

double abrasion(const ParticleSystem &particles)
{
  double now = 0., before = 0.;
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    now += particles.solid_mass(i);
    before += particles.initial_mass[i];
  }
  return before > 0. ? (before - now) / before : 0.;
}

double unbalanced_force_ratio(const ParticleSystem &particles,
                              const ContactBatch &pairs)
{
  const double mean_force = contact_network(particles, pairs).mean_force;
  double sum = 0.;
  for (const ParticleLoad &load : particles.load)
    sum += load.force.norm();
  return mean_force > 0.
             ? sum / static_cast<double>(particles.size()) / mean_force
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
