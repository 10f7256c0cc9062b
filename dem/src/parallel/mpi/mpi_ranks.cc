#include "../weighted_points.h"
#include "check.h"
#include "delivery.h"
#include "zoltan_boxes.h"
#include "zoltan_plan.h"

#include <dem/assert.h>
#include <dem/parallel/mpi_ranks.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace dem
{
namespace
{
int mpi_count(std::size_t n)
{
  if (n > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw std::runtime_error("message of " + std::to_string(n) +
                             " entries: MPI takes 2^31 - 1 at most");
  return static_cast<int>(n);
}

/// Shares of the largest weight as whole numbers from 1 to 2^20, of which a
/// float and sums of doubles keep every digit.
std::vector<float> whole_weights(std::span<const float> weights, double largest)
{
  std::vector<float> whole;
  whole.reserve(weights.size());
  for (const float weight : weights)
    whole.push_back(static_cast<float>(
        std::max(1., std::nearbyint(weight / largest * 0x1p20))));
  return whole;
}

class MpiRanks : public Ranks
{
public:
  MpiRanks();

  int rank() const override { return own.rank(); }
  int size() const override { return own.size(); }

  void sum(std::span<std::int64_t> values) const override;
  void max(std::span<double> values) const override;
  std::vector<std::vector<std::byte>>
  gather(std::span<const std::byte> bytes) const override;

  std::vector<Parcel> deliver(std::vector<Parcel> parcels) const override
  {
    return deliver_parcels(own, planning, std::move(parcels));
  }
  std::unique_ptr<ExchangePlan>
  plan(std::span<const int> destination) const override
  {
    return std::make_unique<ZoltanPlan>(planning, destination);
  }

  void partition(std::span<const Vec3> points,
                 std::span<const float> weights) override;
  int owner(const Vec3 &point) const override { return boxes.owner(point); }
  void owners(const Vec3 &lower, const Vec3 &upper,
              std::vector<int> &ranks) const override
  {
    boxes.owners(lower, upper, ranks);
  }

private:
  Communicator own;
  std::shared_ptr<const Communicator> planning; ///< for Zoltan alone
  ZoltanBoxes boxes;
};

MpiRanks::MpiRanks()
    : own(MPI_COMM_WORLD, OnMpiFailure::return_code),
      planning(std::make_shared<Communicator>(MPI_COMM_WORLD,
                                              OnMpiFailure::end_program)),
      boxes(*planning)
{
}

void MpiRanks::sum(std::span<std::int64_t> values) const
{
  std::int64_t *entries = values.data();
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, entries, mpi_count(values.size()),
                          MPI_INT64_T, MPI_SUM, own.get()),
            "sum over ranks");
}

void MpiRanks::max(std::span<double> values) const
{
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, values.data(), mpi_count(values.size()),
                          MPI_DOUBLE, MPI_MAX, own.get()),
            "find the largest values of all ranks");
}

std::vector<std::vector<std::byte>>
MpiRanks::gather(std::span<const std::byte> bytes) const
{
  const auto n_ranks = static_cast<std::size_t>(size());
  const auto own_size = static_cast<std::int64_t>(bytes.size());
  std::vector<std::int64_t> sizes(n_ranks);
  std::int64_t *entries = sizes.data();
  check_mpi(MPI_Allgather(&own_size, 1, MPI_INT64_T, entries, 1, MPI_INT64_T,
                          own.get()),
            "gather sizes");
  std::vector<int> counts, begins;
  std::size_t total = 0;
  for (const std::int64_t n : sizes)
  {
    begins.push_back(mpi_count(total));
    counts.push_back(mpi_count(static_cast<std::size_t>(n)));
    total += static_cast<std::size_t>(n);
  }
  std::vector<std::byte> joined(total);
  check_mpi(MPI_Allgatherv(bytes.data(),
                           counts[static_cast<std::size_t>(rank())], MPI_BYTE,
                           joined.data(), counts.data(), begins.data(),
                           MPI_BYTE, own.get()),
            "gather bytes");
  std::vector<std::vector<std::byte>> parts;
  for (std::size_t k = 0; k < n_ranks; ++k)
  {
    const auto begin = joined.begin() + begins[k];
    parts.emplace_back(begin, begin + counts[k]);
  }
  return parts;
}

void MpiRanks::partition(std::span<const Vec3> points,
                         std::span<const float> weights)
{
  DEM_ASSERT(points.size() == weights.size());
  const bool is_sound = are_sound(points, weights);
  double largest = 0.;
  if (is_sound && !weights.empty())
    largest = std::ranges::max(weights);
  std::array<double, 2> of_all = {largest, is_sound ? 0. : 1.};
  max(of_all);
  if (of_all[1] > 0.)
    refuse_points();
  if (of_all[0] > 0.)
    boxes.divide(points, whole_weights(weights, of_all[0]));
}
} // namespace

std::shared_ptr<Ranks> mpi_ranks()
{
  if (!mpi_is_running())
    throw std::logic_error("ranks of MPI: MPI is not running");
  return std::make_shared<MpiRanks>();
}

std::shared_ptr<Ranks> ranks_of_program()
{
  if (!mpi_is_running())
    return one_rank();
  std::shared_ptr<Ranks> all = mpi_ranks();
  return all->size() > 1 ? all : one_rank();
}
} // namespace dem
