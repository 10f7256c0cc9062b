#pragma once

#include <dem/engine.h>

#include <string>

namespace spall
{
/// Reports contacts that are deeper than OverlapLimits::warning.
class OverlapNews
{
public:
  /// What the engine has seen until now is known already.
  explicit OverlapNews(const dem::Engine &engine);

  /// A line the first time, and whenever the largest overlap over radius has
  /// grown by half since; else empty.
  std::string news(const dem::Engine &engine);

private:
  double reported = 0.; ///< overlap over radius of the last line; 0: none [-]
};
} // namespace spall
