#include "case/parameter.h"

#include "case/overloaded.h"
#include "case/text.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <numeric>
#include <sstream>
#include <stdexcept>

namespace spall
{
namespace
{
std::string range_text(const std::string &what, const Range &range)
{
  if (range.lower == range.upper)
    return what + " equal to " + number_text(range.lower);
  std::string text = what;
  if (std::isfinite(range.lower))
    text += (range.is_lower_open ? " above " : " of at least ") +
            number_text(range.lower);
  if (std::isfinite(range.upper))
    text += (std::isfinite(range.lower) ? " and" : "") +
            std::string(range.is_upper_open ? " below " : " at most ") +
            number_text(range.upper);
  return text;
}

[[noreturn]] void refuse(const Parameter &parameter)
{
  throw std::invalid_argument("must be " + allowed(parameter));
}

/// As summary.json needs it.
bool is_utf8(const std::string &text)
{
  try
  {
    return !nlohmann::json(text).dump().empty();
  }
  catch (const nlohmann::json::type_error &)
  {
    return false;
  }
}

/// Three numbers with commas or blanks between them.
std::vector<std::string> components(std::string text)
{
  std::ranges::replace(text, ',', ' ');
  std::istringstream words(text);
  return {std::istream_iterator<std::string>(words), {}};
}

double number_in_range(const Parameter &parameter, const std::string &text)
{
  double value = 0.;
  try
  {
    value = to_number(text);
  }
  catch (const std::invalid_argument &)
  {
    refuse(parameter);
  }
  if (!parameter.range.contains(value))
    refuse(parameter);
  return value;
}

int integer_in_range(const Parameter &parameter, const std::string &text)
{
  const double value = number_in_range(parameter, text);
  if (value != std::floor(value) || std::abs(value) > 2147483647.)
    refuse(parameter);
  return static_cast<int>(value);
}

std::size_t edit_distance(const std::string &a, const std::string &b)
{
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j)
    {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({row[j] + 1, row[j + 1] + 1, replaced});
    }
  }
  return row.back();
}
} // namespace

bool Range::contains(double value) const
{
  return (is_lower_open ? value > lower : value >= lower) &&
         (is_upper_open ? value < upper : value <= upper);
}

std::string number_text(double value)
{
  std::array<char, 32> buffer{};
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return {buffer.data(), end};
}

std::string number_text(const dem::Vec3 &value)
{
  return number_text(value.x()) + ", " + number_text(value.y()) + ", " +
         number_text(value.z());
}

double to_number(const std::string &text)
{
  const char *first = text.data() + (text.starts_with('+') ? 1 : 0);
  const char *last = text.data() + text.size();
  double value = 0.;
  const auto [end, error] = std::from_chars(first, last, value);
  if (error != std::errc() || end != last || !std::isfinite(value))
    throw std::invalid_argument("must be a number");
  return value;
}

std::string allowed(const Parameter &parameter)
{
  const std::string text = std::visit(
      Overloaded{
          [&](double *) { return range_text("a number", parameter.range); },
          [&](int *) { return range_text("a whole number", parameter.range); },
          [](bool *) { return std::string("true or false"); },
          [](std::string *) { return std::string("one line of text (UTF-8)"); },
          [&](dem::Vec3 *)
          {
            return "three numbers x, y, z" +
                   (std::isfinite(parameter.range.lower) ||
                            std::isfinite(parameter.range.upper)
                        ? range_text(", each", parameter.range)
                        : "");
          },
          [](const Choice &choice) {
            return (choice.names.size() > 1 ? "one of " : "") +
                   joined(choice.names);
          }},
      parameter.value);
  return parameter.reason.empty() ? text : text + " (" + parameter.reason + ")";
}

std::string usual(const Parameter &parameter)
{
  const Range &range = parameter.usual;
  if (!std::isfinite(range.lower))
    return "";
  return bounds_text(range);
}

std::string bounds_text(const Range &range)
{
  return number_text(range.lower) + " to " + number_text(range.upper);
}

bool is_unusual(double value, const Range &usual)
{
  return value != 0. && !usual.contains(value);
}

bool is_unusual(const Parameter &parameter)
{
  const auto is_outside = [&](double value)
  { return is_unusual(value, parameter.usual); };
  if (const auto *const *value = std::get_if<double *>(&parameter.value))
    return is_outside(**value);
  if (const auto *const *value = std::get_if<dem::Vec3 *>(&parameter.value))
    return std::ranges::any_of(**value, is_outside);
  return false;
}

std::string value_text(const Parameter &parameter)
{
  return std::visit(
      Overloaded{
          [](double *value) { return number_text(*value); },
          [](int *value) { return std::to_string(*value); },
          [](bool *value) { return std::string(*value ? "true" : "false"); },
          [](std::string *value) { return *value; },
          [](dem::Vec3 *value) { return number_text(*value); },
          [](const Choice &choice) { return choice.names[choice.get()]; }},
      parameter.value);
}

void assign(const Parameter &parameter, const std::string &text)
{
  std::visit(
      Overloaded{
          [&](double *value) { *value = number_in_range(parameter, text); },
          [&](int *value) { *value = integer_in_range(parameter, text); },
          [&](bool *value)
          {
            if (text != "true" && text != "false")
              refuse(parameter);
            *value = text == "true";
          },
          [&](std::string *value)
          {
            if (text.find_first_of("\r\n") != std::string::npos ||
                !is_utf8(text))
              refuse(parameter);
            *value = text;
          },
          [&](dem::Vec3 *value)
          {
            const std::vector<std::string> words = components(text);
            if (words.size() != 3)
              refuse(parameter);
            dem::Vec3 given;
            for (std::size_t d = 0; d < 3; ++d)
              given[static_cast<Eigen::Index>(d)] =
                  number_in_range(parameter, words[d]);
            *value = given;
          },
          [&](const Choice &choice)
          {
            const auto found =
                std::find(choice.names.begin(), choice.names.end(), text);
            if (found == choice.names.end())
              refuse(parameter);
            choice.set(static_cast<std::size_t>(found - choice.names.begin()));
          }},
      parameter.value);
}

std::string nearest(const std::string &word,
                    const std::vector<std::string> &known)
{
  std::string best;
  std::size_t least = 1 + word.size() / 2;
  for (const std::string &candidate : known)
    if (const std::size_t d = edit_distance(word, candidate); d < least)
    {
      least = d;
      best = candidate;
    }
  return best;
}
} // namespace spall
