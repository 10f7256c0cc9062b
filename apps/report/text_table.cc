#include "report/text_table.h"

#include "errors.h"
#include "report/text.h"
#include "run/whole_file.h"

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
} // namespace

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
    out += table.note + "\n\n";
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
