#pragma once

#include <dem/vector.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

/// Processes that share a scene. The engine knows them by these classes alone,
/// so that dem builds without MPI; dem/parallel/mpi_ranks.h has those of MPI.
namespace dem
{
/// Items of one size that go from rank to rank along the same ways again and
/// again.
class ExchangePlan
{
public:
  virtual ~ExchangePlan() = default;
  virtual std::size_t n_sent() const = 0;
  virtual std::size_t n_received() const = 0;
  /// Sends item k to the rank that the plan names for it; `received` takes
  /// n_received() items, the same ones in the same order at each call: by the
  /// rank of the sender, then in the order in which it sends them. Collective.
  virtual void forward(const void *items, std::size_t bytes,
                       void *received) = 0;
  /// The way back: item k is the answer to item k that forward() received, and
  /// `returned` takes n_sent() answers in the order of the items sent.
  /// Collective.
  virtual void reverse(const void *items, std::size_t bytes,
                       void *returned) = 0;
};

/// Bytes for one rank, or from one.
struct Parcel
{
  int rank = 0;
  std::vector<std::byte> content;
};

/// All ranks of a scene, and the boxes of space that they own. Every function
/// that is called collective must be called by all ranks in the same order.
class Ranks
{
public:
  virtual ~Ranks() = default;

  virtual int rank() const = 0; ///< of this process, from 0
  virtual int size() const = 0; ///< number of ranks

  /// Sums entry by entry over all ranks. Collective.
  virtual void sum(std::span<std::int64_t> values) const = 0;
  /// Largest entry by entry over all ranks, of numbers without NaN. Collective.
  virtual void max(std::span<double> values) const = 0;
  /// The bytes of every rank on all ranks, by rank. Collective.
  virtual std::vector<std::vector<std::byte>>
  gather(std::span<const std::byte> own) const = 0;

  /// Delivers parcels, at most one for each rank; what arrives is ordered by
  /// the rank of the sender, which Parcel::rank names then. Collective.
  virtual std::vector<Parcel> deliver(std::vector<Parcel> parcels) const = 0;
  /// A plan that sends item k to the rank destination[k]. Collective.
  virtual std::unique_ptr<ExchangePlan>
  plan(std::span<const int> destination) const = 0;

  /// Divides space again: every rank gives its points [m] and their weights >
  /// 0, and owns one box afterwards, all of about the same weight. The outer
  /// boxes reach to infinity. Collective.
  virtual void partition(std::span<const Vec3> points,
                         std::span<const float> weights) = 0;
  /// The rank whose box holds the point. The same on every rank; 0 before the
  /// first partition().
  virtual int owner(const Vec3 &point) const = 0;
  /// The ranks whose boxes meet the box from `lower` to `upper`, in rising
  /// order: among them the owner of each of its points.
  virtual void owners(const Vec3 &lower, const Vec3 &upper,
                      std::vector<int> &ranks) const = 0;
};

/// One process alone: nothing is sent but to itself.
std::shared_ptr<Ranks> one_rank();
} // namespace dem
