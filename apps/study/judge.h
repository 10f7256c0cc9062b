#pragma once

#include "study/pairs.h"

namespace spall
{
enum class Ruling
{
  holds,
  does_not,
  unchanged,   ///< a rise or fall not resolved, but below 5 % of the mean
  not_resolved ///< the seeds differ by more
};

struct Verdict
{
  Ruling ruling = Ruling::not_resolved;
  std::string numbers = {}; ///< that the ruling rests on, each after "; "
  std::string levels = {};  ///< value of the key: mean ± deviation, ...
};

/// Whether the runs show what is expected (see relations), by the rule of the
/// study: from the means over all seeds, or from differences in pairs of cases
/// with the same seed.
Verdict judge(const StudyData &data, const Expectation &expected);

/// By means alone: differences count from 5 % of the mean of all on; what is
/// not shown does not hold.
Verdict judge_means(const std::vector<Level> &levels,
                    const std::string &relation);
} // namespace spall
