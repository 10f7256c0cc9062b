#pragma once

#include <string>
#include <vector>

namespace spall
{
/// Decides how many threads the next step has, from the seconds that the last
/// steps took. It reads no clock, so tests feed it with times of their own.
///
/// A round compares one thread, the number in use, half of it and twice it. The
/// fastest is used until the next round, which is due after a time that keeps
/// the price of rounds at some per cent. A round is due at once when steps on
/// several threads take longer than they took on one thread.
class ThreadPlan
{
public:
  /// `numbers` in rising order, the first is 1. The first round compares all.
  explicit ThreadPlan(std::vector<int> numbers);

  int threads() const { return numbers[current]; } ///< for the next step [-]
  /// Takes in the duration of a step on threads() threads [s].
  void step_took(double seconds);
  /// A line for the log if the number in use has changed; empty if not. After a
  /// line, changes are silent for a minute of steps.
  std::string take_note();

private:
  /// Steps on one number of threads.
  struct Measured
  {
    double seconds = 0.; ///< [s]
    int n_steps = 0;

    double per_step() const { return seconds / n_steps; } ///< [s]
  };

  void begin_round();
  void try_next();
  void end_round();
  bool is_measured() const;
  /// Whether one thread would have done more steps by now.
  bool is_slow_for_several() const;
  void note_change(std::size_t before);

  std::vector<int> numbers;
  std::vector<std::size_t> waiting; ///< candidates of this round, last is next
  std::size_t current = 0;          ///< in `numbers`
  std::size_t kept = 0;             ///< in use between rounds, in `numbers`
  std::size_t fastest = 0;          ///< of this round so far, in `numbers`
  bool is_in_round = false, is_first_round = true;
  Measured present;        ///< on the current number
  Measured best;           ///< on the fastest number of this round
  Measured single;         ///< on one thread, in the last round
  double lost = 0.;        ///< on candidates that were not chosen [s]
  double until_round = 0.; ///< left of the time to the next round [s]
  double until_note = 0.;  ///< left of the silence of the log [s]
  std::string note;
};
} // namespace spall
