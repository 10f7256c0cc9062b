#include "case/text.h"

namespace spall
{
std::string joined(std::span<const std::string> words)
{
  std::string text;
  for (const std::string &word : words)
    text += (text.empty() ? "" : ", ") + word;
  return text;
}
} // namespace spall
