// Memory of a scene over ranks: a rank has its own particles and their
// neighbours, never an entry for each particle of the scene.
#include "counted_heap.h"
#include "dem_scene.h"
#include "test_folder.h"

#include <dem/measure/assembly.h>
#include <dem/parallel/distribution.h>
#include <dem/parallel/mpi_ranks.h>
#include <dem/parallel/shared_input.h>

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>

namespace
{
constexpr double radius = 0.005, spacing = 1.98 * radius; // [m]
constexpr double step = 1e-6;                             // [s]

/// Particles along an edge of the cube: 40, or as the environment says.
int edge_of_cube()
{
  const char *asked = std::getenv("SPALL_PARTICLES_ALONG");
  return asked ? std::atoi(asked) : 40;
}

/// A rank has the particles in a corner of the scene, a small one; the others
/// share the rest in layers.
class CornerRanks : public dem::Ranks
{
public:
  CornerRanks(std::shared_ptr<dem::Ranks> its_ranks, int its_corner_rank,
              double its_corner, double its_edge)
      : all(std::move(its_ranks)), corner_rank(its_corner_rank),
        corner(its_corner), edge(its_edge)
  {
  }

  int rank() const override { return all->rank(); }
  int size() const override { return all->size(); }
  void sum(std::span<std::int64_t> values) const override { all->sum(values); }
  void max(std::span<double> values) const override { all->max(values); }
  std::vector<std::vector<std::byte>>
  gather(std::span<const std::byte> own) const override
  {
    return all->gather(own);
  }
  std::vector<dem::Parcel>
  deliver(std::vector<dem::Parcel> parcels) const override
  {
    return all->deliver(std::move(parcels));
  }
  std::unique_ptr<dem::ExchangePlan>
  plan(std::span<const int> destination) const override
  {
    return all->plan(destination);
  }

  void partition(std::span<const dem::Vec3>, std::span<const float>) override {}
  int owner(const dem::Vec3 &point) const override
  {
    return point.maxCoeff() < corner ? corner_rank : rank_of_layer(point.z());
  }
  void owners(const dem::Vec3 &lower, const dem::Vec3 &upper,
              std::vector<int> &ranks) const override
  {
    ranks.clear();
    for (int rank = 0; rank < size(); ++rank)
      if (rank == corner_rank ? lower.maxCoeff() < corner
                              : rank >= rank_of_layer(lower.z()) &&
                                    rank <= rank_of_layer(upper.z()))
        ranks.push_back(rank);
  }

private:
  int rank_of_layer(double z) const
  {
    const int n = size() - 1;
    const int layer = std::clamp(static_cast<int>(n * z / edge), 0, n - 1);
    return layer < corner_rank ? layer : layer + 1;
  }

  std::shared_ptr<dem::Ranks> all;
  const int corner_rank;
  const double corner, edge;
};

/// Spheres on a lattice that press each other a little, on a floor; the upper
/// layers are left out beyond `n_particles`. All of them move along x, so fast
/// that candidates are searched again after a few steps.
std::unique_ptr<dem::Engine> lattice(int n_along, std::int64_t n_particles,
                                     std::shared_ptr<dem::Ranks> ranks)
{
  auto engine = std::make_unique<dem::Engine>(support::bare_parameters(),
                                              std::move(ranks));
  for (std::int64_t k = 0; k < n_particles; ++k)
    support::add_sphere(*engine, radius,
                        spacing *
                            dem::Vec3(0.5 + double(k % n_along),
                                      0.5 + double(k / n_along % n_along),
                                      0.5 + double(k / n_along / n_along)));
  dem::ParticleSystem &particles = engine->particles();
  for (std::size_t i = 0; i < particles.size(); ++i)
    particles.velocity(i) = 600. * dem::Vec3::UnitX();
  dem::add_plane(*engine, dem::Vec3::Zero(), dem::Vec3::UnitZ());
  return engine;
}

/// All that a run does between two rows of its history, and a new partition.
void run_a_while(dem::Engine &engine)
{
  engine.lists_changed();
  support::advance(engine, step, 3);
  dem::contact_network(engine);
  dem::unbalanced_force_ratio(engine);
}

class Nowhere : public std::streambuf
{
  int_type overflow(int_type c) override { return traits_type::not_eof(c); }
  std::streamsize xsputn(const char *, std::streamsize n) override { return n; }
};

void save(const dem::Engine &engine)
{
  Nowhere nowhere;
  std::ostream out(&nowhere);
  engine.save(out, {}, dem::StateExtent::scene);
}

/// Largest memory while `call` runs, over the number of particles [bytes].
template <class Call>
double peak_of(std::int64_t n_particles, const Call &call)
{
  support::restart_heap_peak();
  call();
  return double(support::heap_peak()) / double(n_particles);
}

TEST(RanksMemory, ThereIsNothingOfAllParticles)
{
  const std::shared_ptr<dem::Ranks> all = dem::mpi_ranks();
  const int n_along = edge_of_cube(), corner = n_along / 8;
  const std::int64_t n_particles = std::int64_t(n_along) * n_along * n_along;
  // A rank with 0.2 % of the particles has no room for an id of each.
  const double most = sizeof(std::int64_t);
  for (const int corner_rank : {all->size() - 1, 0})
  {
    const auto engine =
        lattice(n_along, n_particles,
                std::make_shared<CornerRanks>(
                    all, corner_rank, corner * spacing, n_along * spacing));
    engine->set_partition_interval(1);
    run_a_while(*engine);
    const std::int64_t n_before = engine->distribution().n_partitions();
    const double of_run = peak_of(n_particles, [&] { run_a_while(*engine); });
    EXPECT_GT(engine->distribution().n_partitions(), n_before);
    const double of_saving = peak_of(n_particles, [&] { save(*engine); });
    if (all->rank() != corner_rank)
      continue;
    std::printf("rank %d of %d, bytes per particle of the scene: steps %.1f, "
                "saving %.1f\n",
                corner_rank, all->size(), of_run, of_saving);
    EXPECT_EQ(engine->particles().n_owned(),
              std::size_t(corner) * corner * corner);
    EXPECT_LT(of_run, most);
    // The first rank puts a block after the other into the stream.
    const double block = std::min<double>(double(n_particles) / 16., 16384.);
    const double of_block = corner_rank == 0 ? 3000. * block : 0.;
    EXPECT_LT(of_saving, most + of_block / double(n_particles));
  }
}

TEST(RanksMemory, OfAParticleIsThatOnOneRank)
{
  const std::shared_ptr<dem::Ranks> all = dem::mpi_ranks();
  const int n_along = edge_of_cube();
  const std::int64_t n_particles = std::int64_t(n_along) * n_along * n_along;
  const auto bytes = [&](std::int64_t n, std::shared_ptr<dem::Ranks> ranks)
  {
    const std::int64_t before = support::heap_now();
    const auto engine = lattice(n_along, n, std::move(ranks));
    run_a_while(*engine);
    run_a_while(*engine);
    return double(support::heap_now() - before) /
           double(engine->particles().size());
  };
  const double alone = bytes(n_particles / all->size(), dem::one_rank());
  const double shared = bytes(n_particles, all);
  EXPECT_NEAR(shared, alone, 0.1 * alone);
}

// A checkpoint of which no rank reads more than its share.
TEST(RanksMemory, AStateIsReadInShares)
{
  const std::shared_ptr<dem::Ranks> all = dem::mpi_ranks();
  const int n_along = edge_of_cube();
  const std::int64_t n_particles = std::int64_t(n_along) * n_along * n_along;
  const std::filesystem::path path = support::test_folder() / "state.bin";
  {
    const auto engine = lattice(n_along, n_particles, all);
    run_a_while(*engine);
    std::ofstream out;
    if (all->rank() == 0)
      out.open(path, std::ios::binary);
    engine->save(out, {}, dem::StateExtent::scene);
  }
  std::ifstream file;
  if (all->rank() == 0)
    file.open(path, std::ios::binary);
  dem::SharedInput in(*all, all->rank() == 0 ? &file : nullptr);
  dem::Engine engine(support::bare_parameters(), all);
  const std::int64_t before = support::heap_now();
  support::restart_heap_peak();
  engine.restore(in.stream(), {});
  EXPECT_EQ(engine.n_steps(), 3);
  // Particles on their way to their owners are there twice, and as bytes.
  EXPECT_LT(support::heap_peak() - before, 3 * (support::heap_now() - before));
}
} // namespace
