#pragma once

#include "case/source.h"

#include <string>
#include <vector>

namespace spall
{
/// How a rise or fall continues from one value of the sweep.
enum class Course
{
  plain,
  steeper_from, ///< by more for the same step of the key than before
  level_from,   ///< no further: within 5 %
  turns_at      ///< the other way
};

/// What runs are expected to show: how an outcome goes with a parameter.
struct Expectation
{
  std::string name;
  std::string outcome;  ///< key of summary.json
  std::string relation; ///< one of `relations`
  std::string key;      ///< Section/key
  /// Of answers_more: another key, or a value of where the same key is looked
  /// at again.
  std::string than_key, than_value;
  std::string where_key, where_value;     ///< of the cases used; empty: all
  Course course = Course::plain;          ///< of rises and falls
  std::string course_value;               ///< of the key, where not plain
  bool has_share = false;                 ///< of rises, falls and stays
  double share_low = 0., share_high = 0.; ///< by so much of the first value [-]
  std::string reported;                   ///< what others found, as text
};

/// rises, falls: over the whole sweep, from value to value at most against it
/// by what is noticeable; changes, stays: range above or below 5 % of the mean;
/// settles_low, settles_high: the two smallest or largest values within 5 %;
/// is_positive, is_negative: the outcome itself; answers_more: larger change
/// over the whole sweep than over that of another key, or than with another
/// value of a third.
inline const std::vector<std::string> relations = {
    "rises",        "falls",       "changes",     "stays",       "settles_low",
    "settles_high", "is_positive", "is_negative", "answers_more"};

/// OUTCOME RELATION with KEY [by LOW..HIGH] [steeper_from VALUE |
/// level_from VALUE | turns_at VALUE] [than KEY | than KEY=value]
/// [where KEY=value] [: what others found]. Throws InputError.
Expectation read_expectation(const Assignment &a);

/// The sentence again, without what others found.
std::string in_words(const Expectation &expected);
} // namespace spall
