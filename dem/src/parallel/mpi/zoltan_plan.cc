#include "zoltan_plan.h"

#include "check.h"

#include <dem/assert.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

namespace dem
{
namespace
{
enum Tag
{
  create_tag = 1,
  forward_tag,
  reverse_tag
};

// Zoltan takes pointers to what it only reads without const.
char *bytes_of(const void *items)
{
  return const_cast<char *>(static_cast<const char *>(items));
}
} // namespace

ZoltanPlan::ZoltanPlan(std::shared_ptr<const Communicator> communicator_,
                       std::span<const int> destination)
    : communicator(std::move(communicator_)), n_items_sent(destination.size())
{
  DEM_ASSERT(
      std::ranges::all_of(destination, [this](int r)
                          { return r >= 0 && r < communicator->size(); }));
  ZOLTAN_COMM_OBJ *created = nullptr;
  int n = 0;
  const int code =
      Zoltan_Comm_Create(&created, static_cast<int>(destination.size()),
                         const_cast<int *>(destination.data()),
                         communicator->get(), create_tag, &n);
  plan.reset(created);
  check_zoltan(code, "plan an exchange");
  n_items_received = static_cast<std::size_t>(n);
}

int ZoltanPlan::item_size(std::size_t bytes) const
{
  constexpr std::size_t most = std::numeric_limits<int>::max();
  const std::size_t n = std::max(n_items_sent, n_items_received);
  if (bytes > most || (n > 0 && bytes > most / n))
    throw std::runtime_error(
        "exchange of " + std::to_string(n) + " items of " +
        std::to_string(bytes) +
        " bytes: one rank may send and receive 2^31 - 1 bytes at most");
  return static_cast<int>(bytes);
}

void ZoltanPlan::forward(const void *items, std::size_t bytes, void *received)
{
  check_zoltan(Zoltan_Comm_Do(plan.get(), forward_tag, bytes_of(items),
                              item_size(bytes), static_cast<char *>(received)),
               "send items forward");
}

void ZoltanPlan::reverse(const void *items, std::size_t bytes, void *returned)
{
  check_zoltan(Zoltan_Comm_Do_Reverse(plan.get(), reverse_tag, bytes_of(items),
                                      item_size(bytes), nullptr,
                                      static_cast<char *>(returned)),
               "send items back");
}
} // namespace dem
