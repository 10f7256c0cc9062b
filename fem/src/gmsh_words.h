#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace fem
{
/// The words of a text between blanks, one by one, as the format of gmsh has
/// them. Every call throws std::invalid_argument with the line at the end of
/// the text, and where the word is of another kind: so a loop over a count that
/// the text itself gives ends with the text. The text must outlive this.
class GmshWords
{
public:
  explicit GmshWords(std::string_view whole) : text(whole) {}

  /// False at the end of the text.
  bool has_more();

  std::string_view word();
  std::int64_t integer(); ///< |i| <= 2^53
  std::int64_t count();   ///< an integer from 0 on
  double number();        ///< finite

  /// Goes past this word at the beginning of a line.
  void skip_past(const std::string &line);

  /// Throws std::invalid_argument with the line of the last word.
  [[noreturn]] void refuse(const std::string &what) const;

private:
  void skip_blanks();

  std::string_view text;
  std::size_t offset = 0;
  std::int64_t line = 1;
};
} // namespace fem
