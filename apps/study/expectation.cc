#include "study/expectation.h"

#include "case/fields.h"
#include "report/text.h"
#include "study/words.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

namespace spall
{
namespace
{
constexpr std::array<std::pair<Course, const char *>, 3> courses{
    {{Course::steeper_from, "steeper_from"},
     {Course::level_from, "level_from"},
     {Course::turns_at, "turns_at"}}};

/// KEY=value, the value as a case has it; without one the value is empty.
std::pair<std::string, std::string> key_and_value(const std::string &word)
{
  const std::size_t equals = word.find('=');
  if (equals == std::string::npos)
    return {word, ""};
  return {word.substr(0, equals), same_text(word.substr(equals + 1))};
}

/// Takes LOW..HIGH; false if it is none.
bool read_share(const std::string &word, Expectation &expected)
{
  const std::size_t dots = word.find("..");
  if (dots == std::string::npos)
    return false;
  try
  {
    expected.share_low = to_number(word.substr(0, dots));
    expected.share_high = to_number(word.substr(dots + 2));
  }
  catch (const std::invalid_argument &)
  {
    return false;
  }
  expected.has_share = true;
  return expected.share_low < expected.share_high;
}

/// Takes a pair of words after the key; false if it is none of those allowed.
bool read_pair(const std::string &word, const std::string &next,
               Expectation &expected)
{
  if (word == "by")
    return read_share(next, expected);
  for (const auto &[course, name] : courses)
    if (word == name)
    {
      expected.course = course;
      expected.course_value = same_text(next);
      return true;
    }
  const auto [key, value] = key_and_value(next);
  if (word == "than")
  {
    expected.than_key = key;
    expected.than_value = value;
    return true;
  }
  expected.where_key = key;
  expected.where_value = value;
  return word == "where" && !value.empty();
}

bool is_sound(const Expectation &e)
{
  const bool has_way = e.relation == "rises" || e.relation == "falls";
  return (has_way || e.course == Course::plain) &&
         (has_way || e.relation == "stays" || !e.has_share) &&
         e.than_key.empty() == (e.relation != "answers_more");
}
} // namespace

Expectation read_expectation(const Assignment &a)
{
  const std::size_t colon = a.value.find(':');
  const std::vector<std::string> words =
      words_of(a.value.substr(0, colon), ' ');
  bool is_right = words.size() >= 4 && words.size() % 2 == 0 &&
                  words[2] == "with" &&
                  std::ranges::find(relations, words[1]) != relations.end();
  Expectation expected;
  expected.name = a.key;
  if (is_right)
  {
    expected.outcome = words[0];
    expected.relation = words[1];
    expected.key = words[3];
  }
  for (std::size_t k = 4; is_right && k < words.size(); k += 2)
    is_right = read_pair(words[k], words[k + 1], expected);
  if (!is_right || !is_sound(expected))
    refuse(a, "must be OUTCOME rises|falls|changes|stays|settles_low|"
              "settles_high|is_positive|is_negative|answers_more with "
              "Section/key [by LOW..HIGH] [steeper_from|level_from|turns_at "
              "VALUE] (both of rises and falls, by of stays too) [than "
              "Section/key[=value]] (of answers_more) [where "
              "Section/key=value] [: what others found]");
  if (colon != std::string::npos)
    expected.reported = a.value.substr(
        std::min(a.value.find_first_not_of(' ', colon + 1), a.value.size()));
  return expected;
}

std::string in_words(const Expectation &e)
{
  std::string text = e.outcome + " " + e.relation + " with " + e.key;
  if (e.has_share)
    text += " by " + format(100. * e.share_low, 3) + " to " +
            format(100. * e.share_high, 3) + " %";
  for (const auto &[course, name] : courses)
    if (e.course == course)
      text += std::string(" ") + name + " " + e.course_value;
  const auto condition = [](const std::string &key, const std::string &value)
  { return value.empty() ? key : key + " = " + value; };
  if (!e.than_key.empty())
    text += " than " + condition(e.than_key, e.than_value);
  if (!e.where_key.empty())
    text += " where " + condition(e.where_key, e.where_value);
  return text;
}
} // namespace spall
