#pragma once

#include <coupling/interface_map.h>

namespace coupling
{
enum class RelaxationKind : std::int64_t
{
  constant, ///< the same factor in every pass
  aitken    ///< factor from the last two residuals
};

struct RelaxationParameters
{
  RelaxationKind kind = RelaxationKind::aitken;
  double factor = 0.5;                ///< constant, or of the first pass [-]
  double lowest = 0.01, highest = 1.; ///< bounds of an Aitken factor [-]
};

/// Next guess of a fixed point x = H(x): x + omega (H(x) - x). Aitken's factor,
/// omega <- -omega r_0 . (r_1 - r_0) / |r_1 - r_0|^2, bounded; equal residuals
/// leave it as it is (Irons and Tuck 1969; Kuettler and Wall 2008).
class Relaxation
{
public:
  explicit Relaxation(const RelaxationParameters &its_parameters)
      : parameters(its_parameters), omega(its_parameters.factor)
  {
  }
  /// Moves `guess` by its residual H(guess) - guess.
  void correct(FieldView residual, Field &guess);
  double factor() const { return omega; } ///< of the last correction [-]

private:
  RelaxationParameters parameters;
  double omega;
  Field before; ///< the last residual; empty: none yet
};
} // namespace coupling
