#pragma once

#include <dem/binary.h>

#include <string>
#include <vector>

namespace spall
{
/// A text in a state that is kept, as read_text() takes it.
inline void write_text(std::ostream &out, const std::string &text)
{
  dem::write_column(out, std::vector<char>(text.begin(), text.end()));
}

/// Throws std::runtime_error at the end of the stream, or where no text can be
/// so long.
inline std::string read_text(std::istream &in)
{
  std::vector<char> text;
  dem::read_column(in, text);
  return {text.begin(), text.end()};
}
} // namespace spall
