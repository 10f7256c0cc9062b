#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dem::detail
{
/// The lines of a text one by one, each as its words. The text must outlive
/// this.
class TextLines
{
public:
  explicit TextLines(std::string_view whole);

  /// Goes to the next line; false at the end of the text.
  bool next();

  const std::vector<std::string_view> &words() const { return now; }

  /// The first word of the line in lower case; empty if the line has none.
  const std::string &keyword() const { return first; }

  /// Number of the line, from 1 on.
  long long number() const { return count; }

  /// Throws std::invalid_argument with the line, its number and this.
  [[noreturn]] void refuse(const std::string &what) const;

  /// Three finite numbers of the words after the first. Throws
  /// std::invalid_argument; `form` says what the line must be.
  void numbers(double (&values)[3], const std::string &form) const;

private:
  std::string_view left, line;
  std::vector<std::string_view> now;
  std::string first;
  long long count = 0;
};
} // namespace dem::detail
