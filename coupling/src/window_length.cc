#include <coupling/window_length.h>

#include <algorithm>
#include <cmath>

namespace coupling
{
namespace
{
constexpr std::int64_t length_check_interval = 64; // windows

/// The gain may come to this share of its limit: contacts change between
/// checks.
constexpr double gain_share = 0.8;

/// Windows grow where less than this share of what may is lost.
constexpr double spare = 0.25;
} // namespace

void WindowLength::cap(int most)
{
  longest = std::max(1, most);
  now = std::min(now, longest);
}

bool WindowLength::is_due(std::int64_t n_windows) const
{
  return is_adaptive() && n_windows % length_check_interval == 0;
}

void WindowLength::update(double gain_over_limit, const LedgerSums &books,
                          std::int64_t n_windows)
{
  const double energy_error = books.given - books.taken;
  const double usual = books.moved *
                       static_cast<double>(length_check_interval) /
                       static_cast<double>(n_windows);
  const double moved = std::max(books.moved - moved_before, usual);
  const double share =
      moved > 0. ? std::abs(energy_error - interface_error_before) / moved : 0.;
  interface_error_before = energy_error;
  moved_before = books.moved;
  std::int64_t wanted = now;
  if (share > tolerance)
    wanted = now / 2;
  else if (share < spare * tolerance)
    wanted = now + std::max<std::int64_t>(1, now / 4);
  if (gain_over_limit > 0.) // it goes with the square of the length
    wanted = std::min(wanted, static_cast<std::int64_t>(
                                  static_cast<double>(now) *
                                  std::sqrt(gain_share / gain_over_limit)));
  now = std::clamp<std::int64_t>(wanted, 1, longest);
}
} // namespace coupling
