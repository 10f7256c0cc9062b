#include <dem/neighbor/skin_width.h>

#include <algorithm>
#include <cmath>

namespace dem
{
namespace
{
/// Widths allowed and the first, over the usual one.
constexpr double narrowest = 0.05, widest = 2., first = 0.25;

/// Open pairs per touching one and metre of width [1/m]; 0: not known.
double density(const SkinWidth::Lists &lists, double width)
{
  const std::int64_t n_open = lists.n_listed - lists.n_touching;
  return lists.n_touching > 0 && width > 0.
             ? static_cast<double>(n_open) /
                   (static_cast<double>(lists.n_touching) * width)
             : 0.;
}
} // namespace

// With u the motion per step and p the open pairs per touching one and metre,
// a step costs open_pair p w + rebuild u / w, least at
// w^2 = rebuild u / (open_pair p).
double SkinWidth::best_width(const Lists &now) const
{
  const double motion =
      (width - left) /
      static_cast<double>(std::max<std::int64_t>(now.step - built_at, 1));
  return std::sqrt(now.cost.rebuild * motion /
                   (now.cost.open_pair * open_pairs));
}

void SkinWidth::renew(double usual, const Lists &old)
{
  open_pairs = density(old, width);
  if (given > 0.)
    width = given;
  else if (width <= 0.)
    width = first * usual;
  else if (open_pairs > 0. && old.step > built_at)
    // Half way, so that one odd interval does not decide.
    width = std::clamp(std::sqrt(width * best_width(old)), narrowest * usual,
                       widest * usual);
  left = width;
  built_at = old.step;
}

bool SkinWidth::is_too_wide(const Lists &now)
{
  open_pairs = density(now, width);
  if (given > 0. || open_pairs <= 0.)
    return false;
  const double best = best_width(now);
  const double waste = now.cost.open_pair * open_pairs * (width - best) *
                       static_cast<double>(now.step - built_at);
  return best < 0.5 * width && waste > 2. * now.cost.rebuild;
}
} // namespace dem
