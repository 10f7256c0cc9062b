#include "report/text_table.h"

#include "errors.h"
#include "report/text.h"
#include "run/whole_file.h"

#include <algorithm>
#include <fstream>
#include <sstream>

namespace spall
{
namespace
{
std::string html_row(const Cells &cells, const char *tag)
{
  std::string out = "<tr>";
  for (const std::string &cell : cells)
    out += std::string("<") + tag + ">" + escape(cell) + "</" + tag + ">";
  return out + "</tr>\n";
}

std::string markdown_row(const Cells &cells, std::size_t n)
{
  std::string out = "|";
  for (std::size_t k = 0; k < n; ++k)
  {
    out += ' ';
    for (const char c : k < cells.size() ? cells[k] : std::string())
      out += c == '|' ? std::string("\\|") : std::string(1, c);
    out += " |";
  }
  return out + "\n";
}
/// Bytes of UTF-8 that begin a character.
std::size_t n_characters(const std::string &word)
{
  return static_cast<std::size_t>(std::ranges::count_if(
      word,
      [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

std::string comma_row(const Cells &cells, std::size_t n)
{
  std::string out;
  for (std::size_t k = 0; k < n; ++k)
  {
    const std::string cell = k < cells.size() ? cells[k] : std::string();
    std::string quoted = "\"";
    for (const char c : cell)
      quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    const bool is_plain = cell.find_first_of(",\"\n") == std::string::npos;
    out += (k > 0 ? "," : "") + (is_plain ? cell : quoted + "\"");
  }
  return out + "\n";
}
} // namespace

std::string in_lines(const std::string &text)
{
  constexpr std::size_t width = 120;
  std::istringstream words(text);
  std::string out, word;
  std::size_t length = 0;
  while (words >> word)
  {
    const std::size_t n = n_characters(word);
    if (length > 0)
    {
      const bool fits = length + 1 + n <= width;
      out += fits ? ' ' : '\n';
      length = fits ? length + 1 : 0;
    }
    out += word;
    length += n;
  }
  return out;
}

std::string comma_separated(const TextTable &table)
{
  const std::size_t n = table.head.size();
  std::string out = comma_row(table.head, n);
  for (const Cells &cells : table.rows)
    out += comma_row(cells, n);
  return out;
}

std::string html_rows(const TextTable &table)
{
  std::string out = "<div class=\"wide\"><table><thead>" +
                    html_row(table.head, "th") + "</thead><tbody>\n";
  for (const Cells &cells : table.rows)
    out += html_row(cells, "td");
  return out + "</tbody></table></div>\n";
}

std::string markdown(const TextTable &table)
{
  const std::size_t n = table.head.size();
  std::string out = "## " + table.title + "\n\n";
  if (!table.note.empty())
    out += in_lines(table.note) + "\n\n";
  out += markdown_row(table.head, n) + "|";
  for (std::size_t k = 0; k < n; ++k)
    out += "---|";
  out += "\n";
  for (const Cells &cells : table.rows)
    out += markdown_row(cells, n);
  return out + "\n";
}

std::string page_before(const std::string &command, const std::string &path,
                        const std::string &marker)
{
  std::ifstream file(path, std::ios::binary);
  std::ostringstream before;
  before << file.rdbuf();
  const std::size_t offset = before.str().find(marker + "\n");
  if (!file || offset == std::string::npos)
    throw InputError(command + ": --page " + path +
                     ": must be a file with the line " + marker);
  return before.str().substr(0, offset) + marker + "\n";
}

void renew_page(const std::string &command, const std::string &path,
                const std::string &marker, const std::string &text)
{
  write_text(path, page_before(command, path, marker) + "\n" + text);
}
} // namespace spall
