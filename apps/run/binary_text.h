#pragma once

#include <dem/io/binary.h>

#include <string>
#include <vector>

namespace spall
{
inline void write_text(std::ostream &out, const std::string &text)
{
  dem::write_column(out, std::vector<char>(text.begin(), text.end()));
}

/// Throws std::runtime_error at the end of the stream.
inline std::string read_text(std::istream &in)
{
  std::vector<char> text;
  dem::read_column(in, text);
  return {text.begin(), text.end()};
}
} // namespace spall
