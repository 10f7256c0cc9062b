#pragma once

#include <coupling/ledger.h>

#include <cstdint>

namespace coupling
{
/// How many steps the particles take in a window of one pass: as many as the
/// gain of the present contacts allows, and fewer where too much work goes
/// lost at the interface. Plain data for the checkpoint.
class WindowLength
{
public:
  /// At most so many steps, and unless requested otherwise always so
  /// many.
  explicit WindowLength(int most) : longest(most), now(most) {}

  /// From now on at most this share of the work that crosses the interface is
  /// to are lost; 0: the length stays as it is [-].
  void follow(double interface_error_share)
  {
    tolerance = interface_error_share;
  }
  bool is_adaptive() const { return tolerance > 0.; }
  /// At most so many steps from now on.
  void cap(int most);

  int steps() const { return now; }
  /// Whether a check is due after so many windows.
  bool is_due(std::int64_t n_windows) const;
  /// Checks: `gain` of the present contacts in a window of this length, over
  /// the limit of one pass [-]. Work counts against that of the windows since
  /// the last check, or of as many on average since the start if that is more:
  /// at rest the relative error would be meaningless.
  void update(double gain_over_limit, const LedgerSums &books,
              std::int64_t n_windows);

private:
  std::int64_t longest = 1, now = 1;
  double tolerance = 0.; ///< [-]
  double interface_error_before = 0.,
         moved_before = 0.; ///< at the last check [J]
};
} // namespace coupling
