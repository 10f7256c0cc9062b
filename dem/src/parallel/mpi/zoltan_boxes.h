#pragma once

#include "communicator.h"

#include <dem/vector.h>

#include <memory>
#include <span>
#include <vector>
#include <zoltan.h>

namespace dem
{
/// Boxes of space, one for each rank, by recursive coordinate bisection.
class ZoltanBoxes
{
public:
  /// Collective. The communicator must end the program on failures.
  explicit ZoltanBoxes(const Communicator &communicator);

  /// Cuts lie half way between two points. Weights must be whole numbers > 0:
  /// their sums are exact then, so that the cuts do not depend on which rank
  /// gives which point. At least one rank gives a point. Collective.
  void divide(std::span<const Vec3> points, std::span<const float> weights);

  int owner(const Vec3 &point) const;
  void owners(const Vec3 &lower, const Vec3 &upper,
              std::vector<int> &ranks) const;

private:
  struct Destroy
  {
    void operator()(Zoltan_Struct *zoltan) const;
  };

  const int n_ranks;
  std::unique_ptr<Zoltan_Struct, Destroy> zoltan;
  bool is_divided = false;
};
} // namespace dem
