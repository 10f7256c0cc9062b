#pragma once

#include <dem/vector.h>

#include <functional>
#include <limits>
#include <map>
#include <string>
#include <variant>
#include <vector>

namespace spall
{
/// What a number may be.
struct Range
{
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool is_lower_open = false; ///< lower itself is not allowed
  bool is_upper_open = false; ///< upper itself is not allowed

  bool contains(double value) const;
};

constexpr Range between(double lower, double upper)
{
  return {lower, upper, false, false};
}

/// lower < value <= upper.
constexpr Range above(double lower, double upper)
{
  return {lower, upper, true, false};
}

/// lower <= value < upper.
constexpr Range below(double lower, double upper)
{
  return {lower, upper, false, true};
}

/// An enumeration by name; the index in the list is the value.
struct Choice
{
  std::vector<std::string> names;
  std::map<std::string, std::string> old_names; ///< deprecated -> present
  std::function<std::size_t()> get;
  std::function<void(std::size_t)> set;
};

/// One entry of a case: its field, description and range.
struct Parameter
{
  std::string section, key;
  std::string unit;     ///< SI, "-" if none
  std::string sentence; ///< what it is
  std::variant<double *, int *, bool *, std::string *, dem::Vec3 *, Choice>
      value;
  Range range;        ///< of numbers and components
  std::string reason; ///< why this range, if it needs one
  /// Values outside, except 0, are allowed but likely in another unit.
  Range usual = {};
  std::vector<std::string> old_keys = {}; ///< deprecated, still read
  std::string kind = {}; ///< the kind of test that has it; empty: all
  bool is_path = false;  ///< its value is a file or folder, see find_path()
  /// It decides the prepared particles of a kind whose preparations can be
  /// shared (test/preparation_text.h).
  bool decides_preparation = true;
  /// A resumed run may have another value: it ends the run, stops it, or sets
  /// how often something is written, and changes nothing that is computed.
  bool may_change = false;

  bool is_of(const std::string &kind_of_case) const
  {
    return kind.empty() || kind == kind_of_case;
  }
  std::string name() const { return section + "/" + key; }
};

/// "a number above 0 and below 0.5", "one of membrane, rigid", ...
std::string allowed(const Parameter &parameter);

/// "500 to 1e+09", empty if no range is usual.
std::string usual(const Parameter &parameter);

/// "500 to 1e+09"
std::string bounds_text(const Range &range);

/// Whether a value other than 0 is outside its usual range.
bool is_unusual(const Parameter &parameter);
bool is_unusual(double value, const Range &usual);

/// The value as text that assign takes back without loss.
std::string value_text(const Parameter &parameter);

/// Throws std::invalid_argument with what is allowed.
void assign(const Parameter &parameter, const std::string &text);

/// Shortest text that reads back as the same number.
std::string number_text(double value);

/// Its three components with commas.
std::string number_text(const dem::Vec3 &value);

/// The whole text as a finite number; throws std::invalid_argument.
double to_number(const std::string &text);

/// Of the known words the one nearest to `word` by edits; empty if none is
/// near.
std::string nearest(const std::string &word,
                    const std::vector<std::string> &known);
} // namespace spall
