#include "report/text.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace spall
{
namespace
{
constexpr const char *en_dash = "\u2013";
constexpr const char *minus_sign = "\u2212";

/// A true minus, and no minus before zero.
std::string with_true_minus(std::string text)
{
  if (text[0] == '-' && text.find_first_of("123456789") == std::string::npos)
    text.erase(0, 1);
  return text[0] == '-' ? minus_sign + text.substr(1) : text;
}

/// 3·10⁻⁴
std::string scientific(double value, int n_digits)
{
  char text[64];
  std::snprintf(text, sizeof text, "%.*e", n_digits - 1, value);
  const std::string all(text),
      exponent =
          std::to_string(std::atoi(all.substr(all.find('e') + 1).c_str()));
  static const char *const raised[] = {"⁰", "¹", "²", "³", "⁴",
                                       "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string out = with_true_minus(all.substr(0, all.find('e'))) + "·10";
  for (const char c : exponent)
    out += c == '-' ? "⁻" : raised[c - '0'];
  return out;
}
} // namespace

std::string escape(const std::string &text)
{
  std::string out;
  for (const char c : text)
    switch (c)
    {
    case '&':
      out += "&amp;";
      break;
    case '<':
      out += "&lt;";
      break;
    case '>':
      out += "&gt;";
      break;
    case '"':
      out += "&quot;";
      break;
    case '\'':
      out += "&#39;";
      break;
    default:
      out += c;
    }
  return out;
}

std::string format(double value, int n_digits)
{
  if (!std::isfinite(value))
    return en_dash;
  const double size = std::abs(value);
  if (size != 0. && (size < 1e-3 || size >= 1e6))
    return scientific(value, n_digits);
  const int order =
      size == 0. ? 0 : static_cast<int>(std::floor(std::log10(size)));
  return format_fixed(value, std::max(0, n_digits - 1 - order));
}

std::string format_fixed(double value, int n_decimals)
{
  if (!std::isfinite(value))
    return en_dash;
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", n_decimals, value);
  return with_true_minus(text);
}

std::string base64(const std::string &bytes)
{
  static const char digits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t k = 0; k < bytes.size(); k += 3)
  {
    std::uint32_t group = 0;
    for (std::size_t i = 0; i < 3; ++i)
      group = group << 8 |
              (k + i < bytes.size() ? static_cast<unsigned char>(bytes[k + i])
                                    : 0u);
    for (int shift = 18; shift >= 0; shift -= 6)
      out += digits[group >> shift & 63];
  }
  for (std::size_t k = 0; k < (3 - bytes.size() % 3) % 3; ++k)
    out[out.size() - 1 - k] = '=';
  return out;
}
} // namespace spall
