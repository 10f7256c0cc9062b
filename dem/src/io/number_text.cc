#include "number_text.h"

#include <charconv>
#include <cmath>
#include <cstdlib>

namespace dem::detail
{
std::optional<double> any_number_in(std::string_view word)
{
  if (word.starts_with('+'))
    word.remove_prefix(1);
  double value = 0.;
  const char *last = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), last, value);
  if (word.empty() || stop != last)
    return std::nullopt;
  if (error == std::errc::result_out_of_range) // too small is 0, too large inf
    value = std::strtod(std::string(word).c_str(), nullptr);
  else if (error != std::errc())
    return std::nullopt;
  return value;
}

std::optional<double> number_in(std::string_view word)
{
  const std::optional<double> value = any_number_in(word);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::string comma_hint(std::string_view word)
{
  const std::size_t comma = word.find(',');
  if (comma == std::string_view::npos)
    return "";
  std::string mended(word);
  mended[comma] = '.';
  if (!number_in(mended))
    return "";
  return " (a decimal comma: write " + mended + ")";
}
} // namespace dem::detail
