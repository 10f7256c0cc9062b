#include "gmsh_words.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <stdexcept>

namespace fem
{
namespace
{
constexpr std::string_view blanks = " \t\r\n\v\f";

/// The finite number that the word is.
std::optional<double> number_of(std::string_view word)
{
  if (word.starts_with('+'))
    word.remove_prefix(1);
  double value = 0.;
  const char *last = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), last, value);
  if (word.empty() || stop != last)
    return std::nullopt;
  if (error == std::errc::result_out_of_range) // too small is 0
    value = std::strtod(std::string(word).c_str(), nullptr);
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::string shown(std::string_view word)
{
  std::string result;
  for (const char c : word.substr(0, 40))
    result += c >= ' ' && c <= '~' ? c : '?';
  return '"' + result + '"';
}
} // namespace

void GmshWords::refuse(const std::string &what) const
{
  throw std::invalid_argument("line " + std::to_string(line) + ": " + what);
}

void GmshWords::skip_blanks()
{
  for (; offset < text.size() && blanks.find(text[offset]) != blanks.npos;
       ++offset)
    line += text[offset] == '\n' ? 1 : 0;
}

bool GmshWords::has_more()
{
  skip_blanks();
  return offset < text.size();
}

std::string_view GmshWords::word()
{
  if (!has_more())
    refuse("ends too early: is the file cut off?");
  const std::size_t end =
      std::min(text.find_first_of(blanks, offset), text.size());
  const std::string_view found = text.substr(offset, end - offset);
  offset = end;
  return found;
}

double GmshWords::number()
{
  const std::string_view found = word();
  const std::optional<double> value = number_of(found);
  if (value)
    return *value;
  std::string mended(found);
  std::replace(mended.begin(), mended.end(), ',', '.');
  refuse(shown(found) + " where a number should be" +
         (mended != found && number_of(mended)
              ? " (a decimal comma: write " + mended + ")"
              : ""));
}

std::int64_t GmshWords::integer()
{
  constexpr double most = 9007199254740992.;
  const double value = number();
  if (value != std::floor(value) || std::abs(value) > most)
    refuse(std::to_string(value) + " where a whole number should be");
  return static_cast<std::int64_t>(value);
}

std::int64_t GmshWords::count()
{
  const std::int64_t value = integer();
  if (value < 0)
    refuse(std::to_string(value) + " where a number from 0 on should be");
  return value;
}

void GmshWords::skip_past(const std::string &wanted)
{
  std::size_t found = text.find(wanted, offset);
  while (found != text.npos && found > 0 && text[found - 1] != '\n')
    found = text.find(wanted, found + 1);
  if (found == text.npos)
    refuse("no " + wanted + " after it: is the file cut off?");
  line += std::count(text.begin() + std::ptrdiff_t(offset),
                     text.begin() + std::ptrdiff_t(found), '\n');
  offset = found + wanted.size();
}
} // namespace fem
