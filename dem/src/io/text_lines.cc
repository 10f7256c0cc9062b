#include "text_lines.h"

#include "number_text.h"

#include <algorithm>
#include <cctype>
#include <stdexcept>

namespace dem::detail
{
namespace
{
constexpr std::string_view blanks = " \t\r\v\f";

void split(std::string_view line, std::vector<std::string_view> &words)
{
  words.clear();
  for (std::size_t from = line.find_first_not_of(blanks);
       from != std::string_view::npos;)
  {
    const std::size_t to =
        std::min(line.find_first_of(blanks, from), line.size());
    words.push_back(line.substr(from, to - from));
    from = line.find_first_not_of(blanks, to);
  }
}

/// What can be printed of a line.
std::string shown(std::string_view line)
{
  constexpr std::size_t most = 80;
  std::string text;
  for (const char c : line.substr(0, most))
    text += std::isprint(static_cast<unsigned char>(c)) ? c : ' ';
  while (!text.empty() && text.back() == ' ')
    text.pop_back();
  return '"' + text + (line.size() > most ? " ...\"" : "\"");
}
} // namespace

TextLines::TextLines(std::string_view whole) : left(whole)
{
  if (left.starts_with("\xEF\xBB\xBF")) // byte order mark of some editors
    left.remove_prefix(3);
}

bool TextLines::next()
{
  if (left.empty())
    return false;
  const std::size_t end = std::min(left.find('\n'), left.size());
  line = left.substr(0, end);
  left.remove_prefix(std::min(end + 1, left.size()));
  ++count;
  split(line, now);
  first.clear();
  if (!now.empty())
    for (const char c : now[0])
      first += char(std::tolower(static_cast<unsigned char>(c)));
  return true;
}

void TextLines::refuse(const std::string &what) const
{
  throw std::invalid_argument("line " + std::to_string(count) + ": " +
                              shown(line) + ": " + what);
}

void TextLines::numbers(double (&values)[3], const std::string &form) const
{
  if (now.size() < 4)
    refuse("must be " + form);
  for (std::size_t d = 0; d < 3; ++d)
  {
    const auto value = number_in(now[d + 1]);
    if (!value)
      refuse("must be " + form + comma_hint(now[d + 1]));
    values[d] = *value;
  }
}
} // namespace dem::detail
