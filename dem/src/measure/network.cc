#include <dem/measure/network.h>

#include <Eigen/Eigenvalues>

#include <cmath>
#include <numbers>
#include <numeric>

namespace dem
{
namespace
{
double normal_force(const PairContact &contact)
{
  return -contact.force.dot(contact.normal);
}

/// Major principal stress and its axis.
struct MajorStress
{
  double value = 0.;         ///< [Pa]
  Vec3 axis = Vec3::UnitZ(); ///< [-]
};

std::vector<MajorStress> major_stresses(const std::vector<Mat3> &stresses)
{
  std::vector<MajorStress> majors;
  Eigen::SelfAdjointEigenSolver<Mat3> solver;
  for (const Mat3 &stress : stresses)
  {
    solver.compute(stress);
    majors.push_back({solver.eigenvalues()[2], solver.eigenvectors().col(2)});
  }
  return majors;
}

/// Of the particles with a contact [Pa].
double mean_of_bearing(const std::vector<MajorStress> &majors,
                       const Network &network)
{
  std::vector<bool> bears(majors.size(), false);
  for (const PairContact &contact : network.pairs)
    bears[static_cast<std::size_t>(contact.a)] =
        bears[static_cast<std::size_t>(contact.b)] = true;
  for (const WallContact &contact : network.walls)
    bears[static_cast<std::size_t>(contact.particle)] = true;
  double sum = 0.;
  std::int64_t n = 0;
  for (std::size_t i = 0; i < majors.size(); ++i)
    if (bears[i])
    {
      sum += majors[i].value;
      ++n;
    }
  return n > 0 ? sum / static_cast<double>(n) : 0.;
}

/// Sets of particles that are linked, by the number of one particle of the set.
class Links
{
public:
  explicit Links(std::size_t n) : next(n)
  {
    std::iota(next.begin(), next.end(), std::size_t{0});
  }
  std::size_t root(std::size_t i)
  {
    while (next[i] != i)
      i = next[i] = next[next[i]];
    return i;
  }
  void join(std::size_t i, std::size_t j) { next[root(i)] = root(j); }

private:
  std::vector<std::size_t> next;
};

ForceChains count_chains(Links &links, std::size_t n_particles)
{
  std::vector<std::int64_t> size(n_particles, 0);
  for (std::size_t i = 0; i < n_particles; ++i)
    ++size[links.root(i)];
  ForceChains chains;
  std::int64_t n_in_chains = 0;
  for (const std::int64_t length : size)
    if (length >= 3)
    {
      ++chains.n_chains;
      n_in_chains += length;
    }
  if (chains.n_chains > 0)
  {
    chains.share =
        static_cast<double>(n_in_chains) / static_cast<double>(n_particles);
    chains.mean_length =
        static_cast<double>(n_in_chains) / static_cast<double>(chains.n_chains);
  }
  return chains;
}
} // namespace

Mat3 fabric_tensor(std::span<const PairContact> pairs)
{
  Mat3 sum = Mat3::Zero();
  for (const PairContact &contact : pairs)
    sum += contact.normal * contact.normal.transpose();
  return pairs.empty() ? sum : Mat3(sum / static_cast<double>(pairs.size()));
}

double fabric_anisotropy(const Mat3 &fabric)
{
  const Mat3 deviator = 7.5 * (fabric - fabric.trace() / 3. * Mat3::Identity());
  return std::sqrt(1.5) * deviator.norm();
}

double sliding_fraction(std::span<const PairContact> pairs)
{
  std::int64_t n = 0;
  for (const PairContact &contact : pairs)
    n += contact.is_sliding;
  return pairs.empty()
             ? 0.
             : static_cast<double>(n) / static_cast<double>(pairs.size());
}

double strong_share(std::span<const PairContact> pairs)
{
  if (pairs.empty())
    return 0.;
  const auto n = static_cast<double>(pairs.size());
  double sum = 0.;
  for (const PairContact &contact : pairs)
    sum += normal_force(contact);
  std::int64_t n_strong = 0;
  for (const PairContact &contact : pairs)
    n_strong += normal_force(contact) > sum / n;
  return static_cast<double>(n_strong) / n;
}

std::vector<Mat3> particle_stress(const ParticleSystem &particles,
                                  const Network &network)
{
  std::vector<Mat3> sum(particles.size(), Mat3::Zero());
  const auto add = [&](std::int32_t particle, const Vec3 &point,
                       const Vec3 &force, const Mat3 &spread = Mat3::Zero())
  {
    const auto i = static_cast<std::size_t>(particle);
    const Vec3 lever = point - particles.position(i);
    const PeriodicCell &cell = particles.cell;
    const Mat3 moment =
        force * (cell.is_there() ? cell.nearest(lever) : lever).transpose() +
        spread;
    sum[i] -= 0.5 * (moment + moment.transpose()) / particles.shape[i].volume;
  };
  for (const PairContact &contact : network.pairs)
  {
    add(contact.a, contact.point, contact.force);
    add(contact.b, contact.point, -contact.force);
  }
  for (const WallContact &contact : network.walls)
    add(contact.particle, contact.point, contact.force, contact.spread);
  return sum;
}

ForceChains force_chains(const ParticleSystem &particles,
                         const Network &network)
{
  const std::vector<MajorStress> majors =
      major_stresses(particle_stress(particles, network));
  const double mean = mean_of_bearing(majors, network);
  const double least_cosine = 0.5 * std::numbers::sqrt2;
  Links links(particles.size());
  for (const PairContact &contact : network.pairs)
  {
    const auto a = static_cast<std::size_t>(contact.a),
               b = static_cast<std::size_t>(contact.b);
    const Vec3 branch = particles.branch(a, b).normalized();
    const auto is_in_line = [&](const MajorStress &major)
    {
      return major.value > mean &&
             std::abs(major.axis.dot(branch)) >= least_cosine;
    };
    if (is_in_line(majors[a]) && is_in_line(majors[b]))
      links.join(a, b);
  }
  return count_chains(links, particles.size());
}
} // namespace dem
