#pragma once

#include "communicator.h"

#include <dem/parallel/ranks.h>

#include <zoltan_comm.h>

namespace dem
{
/// A plan of Zoltan. It receives items by the rank of their sender, and those
/// of one sender in the order in which it sends them.
class ZoltanPlan : public ExchangePlan
{
public:
  /// Collective. The communicator must end the program on failures.
  ZoltanPlan(std::shared_ptr<const Communicator> communicator,
             std::span<const int> destination);

  std::size_t n_sent() const override { return n_items_sent; }
  std::size_t n_received() const override { return n_items_received; }
  void forward(const void *items, std::size_t bytes, void *received) override;
  void reverse(const void *items, std::size_t bytes, void *returned) override;

private:
  struct Destroy
  {
    void operator()(ZOLTAN_COMM_OBJ *plan) const { Zoltan_Comm_Destroy(&plan); }
  };

  /// The size of an item as Zoltan wants it, throws if a message is too long.
  int item_size(std::size_t bytes) const;

  std::shared_ptr<const Communicator> communicator; ///< outlives the plan
  std::unique_ptr<ZOLTAN_COMM_OBJ, Destroy> plan;
  std::size_t n_items_sent = 0, n_items_received = 0;
};
} // namespace dem
