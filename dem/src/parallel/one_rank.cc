#include "weighted_points.h"

#include <dem/assert.h>
#include <dem/parallel/ranks.h>

#include <algorithm>
#include <cstring>

namespace dem
{
namespace
{
void copy_items(const void *from, std::size_t n_bytes, void *to)
{
  if (n_bytes > 0)
    std::memmove(to, from, n_bytes);
}

/// Every item goes to this process and stays in its order.
class OneRankPlan : public ExchangePlan
{
public:
  explicit OneRankPlan(std::size_t n_items) : n(n_items) {}

  std::size_t n_sent() const override { return n; }
  std::size_t n_received() const override { return n; }
  void forward(const void *items, std::size_t bytes, void *received) override
  {
    copy_items(items, n * bytes, received);
  }
  void reverse(const void *items, std::size_t bytes, void *returned) override
  {
    copy_items(items, n * bytes, returned);
  }

private:
  const std::size_t n;
};

class OneRank : public Ranks
{
public:
  int rank() const override { return 0; }
  int size() const override { return 1; }

  void sum(std::span<std::int64_t>) const override {}
  void max(std::span<double>) const override {}
  std::vector<std::vector<std::byte>>
  gather(std::span<const std::byte> own) const override
  {
    return {{own.begin(), own.end()}};
  }

  std::vector<Parcel> deliver(std::vector<Parcel> parcels) const override
  {
    DEM_ASSERT(parcels.size() <= 1);
    DEM_ASSERT(parcels.empty() || parcels.front().rank == 0);
    return parcels;
  }
  std::unique_ptr<ExchangePlan>
  plan(std::span<const int> destination) const override
  {
    DEM_ASSERT(std::ranges::all_of(destination, [](int r) { return r == 0; }));
    return std::make_unique<OneRankPlan>(destination.size());
  }

  void partition(std::span<const Vec3> points,
                 std::span<const float> weights) override
  {
    if (!are_sound(points, weights))
      refuse_points();
  }
  int owner(const Vec3 &) const override { return 0; }
  void owners(const Vec3 &, const Vec3 &,
              std::vector<int> &ranks) const override
  {
    ranks.assign(1, 0);
  }
};
} // namespace

std::shared_ptr<Ranks> one_rank()
{
  return std::make_shared<OneRank>();
}
} // namespace dem
