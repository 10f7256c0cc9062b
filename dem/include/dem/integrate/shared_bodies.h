#pragma once

#include <dem/exact_sum.h>

#include <cstddef>
#include <span>

namespace dem
{
/// Which bodies of a network of springs a rank owns. Each body has one owner,
/// which has all contacts of it in the order that they have on one rank. This
/// class is of one rank, which has everything.
class SharedBodies
{
public:
  virtual ~SharedBodies() = default;
  virtual bool is_owned(std::size_t) const { return true; }
  /// Of the same number of entries for each body: those of bodies of other
  /// ranks become what their owners have. Collective.
  virtual void fill(std::span<double>) const {}
  /// Largest entry by entry over all ranks. Collective.
  virtual void largest(std::span<double>) const {}
  /// Sums entry by entry over all ranks. Collective.
  virtual void sum(std::span<ExactSum>) const {}
};
} // namespace dem
