#pragma once

#include "study/study.h"

#include <span>

namespace spall
{
/// What the cases with one value of a swept key gave, over seeds (and, in a
/// grid, the other keys).
struct Level
{
  std::string value;
  double x = 0.; ///< the value as a number, or its place
  std::vector<double> samples;

  double mean() const;      ///< NaN without samples
  double deviation() const; ///< standard, of the samples; 0 for one
};

/// The cases of a study with what they gave.
struct StudyData
{
  const Study &study;
  std::span<const StudyPoint> points;
  std::span<const PointResult> results;
};

/// Whether the case is a point of the sweep of key k.
bool is_in_sweep(const StudyData &data, std::size_t point, std::size_t k);

/// Levels of key k in order of their values; `outcome` is a place in
/// Study::outcomes. Values that are all numbers are sorted.
std::vector<Level> levels_of(const StudyData &data, std::size_t k,
                             std::size_t outcome);

struct Verdict
{
  bool is_shown = false;
  std::string numbers; ///< the means it is judged by
};

/// Whether the levels go as `relation` says (see relations): differences of
/// the means count from 5 % of the mean of all on.
Verdict judge(const std::vector<Level> &levels, const std::string &relation);
} // namespace spall
