#pragma once

#include "study/estimate.h"
#include "study/study.h"

#include <optional>

namespace spall
{
/// What the cases with one value of a swept key gave, over seeds (and, in a
/// grid, the other keys).
struct Level
{
  std::string value;
  double x = 0.; ///< the value as a number, or its index
  std::vector<double> samples;

  double mean() const;      ///< NaN without samples
  double deviation() const; ///< standard, of the samples; 0 for one
};

/// The cases of the sweep of a key, all or those with one value of another.
struct Cut
{
  explicit Cut(std::size_t of_key) : key(of_key) {}

  std::size_t key;
  std::optional<std::size_t> where_key = {};
  std::string where_value = "";

  bool takes(const StudyPoint &point) const;
};

/// Series of the charts and tables of a key: its cases with each variant, or,
/// in a grid of two keys, with each value of the other; else all of them.
std::vector<Cut> series_of(const StudyData &data, std::size_t key);

/// Index of a key among those of the study. Throws std::logic_error.
std::size_t index_of(const Study &study, const std::string &key_name);

/// Whether all other keys of the point are as in the base case; true of all
/// points where none is the base case.
bool is_beside_base(const StudyData &data, std::size_t key,
                    const StudyPoint &point);

/// Indices of the cases that are done and have this value of the key, in a grid
/// with all other keys as in the base case: those that curves are drawn of.
std::vector<std::size_t> drawn_cases(const StudyData &data, std::size_t key,
                                     const std::string &value);

/// Levels of the key in order of their values; `outcome` is an index in
/// Study::outcomes. Values that are all numbers are sorted.
std::vector<Level> levels_of(const StudyData &data, const Cut &cut,
                             std::size_t outcome);
} // namespace spall
