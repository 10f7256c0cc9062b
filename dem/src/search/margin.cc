#include <dem/search/margin.h>

#include <algorithm>
#include <cmath>

namespace dem
{
namespace
{
/// Cost of a listed pair that does not touch over that of one that does.
constexpr double open_cost = 0.5;
/// Widths allowed, in first widths.
constexpr double narrowest = 0.1, widest = 2.;
} // namespace

// With u the motion per step and p the open pairs per touching one and metre,
// a step costs open_cost p w + rebuild_cost u / w, least at
// w^2 = rebuild_cost u / (open_cost p).
void SearchMargin::renew(double first, std::int64_t step, std::int64_t n_listed,
                         std::int64_t n_touching, double rebuild_cost)
{
  const auto steps = static_cast<double>(step - built_at);
  if (width <= 0.)
    width = first;
  else if (steps > 0. && n_touching > 0 && n_listed > n_touching)
  {
    const double motion = (width - left) / steps;
    const double open_pairs = static_cast<double>(n_listed - n_touching) /
                              static_cast<double>(n_touching) / width;
    const double best =
        std::sqrt(rebuild_cost * motion / (open_cost * open_pairs));
    // Half way, so that one odd interval does not decide.
    width =
        std::clamp(std::sqrt(width * best), narrowest * first, widest * first);
  }
  left = width;
  built_at = step;
}
} // namespace dem
