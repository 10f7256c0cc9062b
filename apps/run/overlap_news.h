#pragma once

#include <dem/engine.h>

#include <string>

namespace spall
{
/// Reports contacts of any rank that are deeper than OverlapLimits::warning.
class OverlapNews
{
public:
  /// Overlaps of the engine until now have been reported. Collective.
  explicit OverlapNews(const dem::Engine &engine);

  /// A line the first time, and whenever the largest overlap over radius has
  /// grown by half since; else empty. Collective.
  std::string news(const dem::Engine &engine);

private:
  double reported = 0.; ///< overlap over radius of the last line; 0: none [-]
};
} // namespace spall
