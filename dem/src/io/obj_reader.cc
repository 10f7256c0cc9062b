#include "obj_reader.h"

#include "polygon.h"
#include "text_lines.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace dem::detail
{
namespace
{
/// Corners of a face as points of the mesh, and where the file has it.
struct Face
{
  std::vector<std::int32_t> corners;
  long long line = 0;
};

constexpr long long most_points = std::numeric_limits<std::int32_t>::max();

/// The point that a word `a`, `a/b`, `a//c` or `a/b/c` of a face names. Numbers
/// below 0 count back from the vertices before this line.
std::int32_t corner(const TextLines &lines, std::string_view word,
                    std::size_t n_points)
{
  const std::string_view text = word.substr(0, word.find('/'));
  long long number = 0;
  const char *last = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), last, number);
  if (stop != last || error == std::errc::invalid_argument)
    lines.refuse("a face must be f and numbers of vertices");
  const auto n = static_cast<long long>(n_points);
  if (error != std::errc() || number == 0 || number < -n ||
      number > most_points)
    lines.refuse("vertex " + std::string(text) + ", there are " +
                 std::to_string(n_points) +
                 " above this line: must be 1 or more, or below 0 to count "
                 "back");
  return static_cast<std::int32_t>(number < 0 ? n + number : number - 1);
}

Face face(const TextLines &lines, std::size_t n_points)
{
  Face read{{}, lines.number()};
  for (std::size_t k = 1; k < lines.words().size(); ++k)
    if (lines.words()[k].starts_with('#'))
      break;
    else
      read.corners.push_back(corner(lines, lines.words()[k], n_points));
  if (read.corners.size() < 3 || read.corners.size() > most_corners)
    lines.refuse("has " + std::to_string(read.corners.size()) +
                 " corners: a face must have 3 to " +
                 std::to_string(most_corners));
  return read;
}

/// The text with lines that continue after a backslash in one, and as many
/// empty lines after it as were joined.
std::string joined(std::string_view text)
{
  std::string whole;
  std::size_t n_joined = 0;
  for (std::size_t k = 0; k < text.size(); ++k)
  {
    const std::string_view rest = text.substr(k);
    const bool has_return = rest.starts_with("\\\r\n");
    if (has_return || rest.starts_with("\\\n"))
    {
      k += has_return ? 2 : 1;
      ++n_joined;
      whole += ' ';
      continue;
    }
    whole += text[k];
    if (text[k] == '\n')
      whole.append(std::exchange(n_joined, 0), '\n');
  }
  return whole;
}
} // namespace

TriangleMesh read_obj(std::string_view text)
{
  const bool goes_on = text.find('\\') != std::string_view::npos;
  const std::string whole = goes_on ? joined(text) : "";
  TextLines lines(goes_on ? whole : text);
  TriangleMesh mesh;
  std::vector<Face> faces;
  while (lines.next())
    if (lines.keyword() == "v")
    {
      double x[3];
      lines.numbers(x, "v and three numbers");
      mesh.points.emplace_back(x[0], x[1], x[2]);
    }
    else if (lines.keyword() == "f")
      faces.push_back(face(lines, mesh.points.size()));
  for (const Face &one : faces) // a face may stand above its vertices
  {
    const std::int32_t highest = std::ranges::max(one.corners);
    if (std::size_t(highest) >= mesh.points.size())
      throw std::invalid_argument(
          "line " + std::to_string(one.line) + ": a face names vertex " +
          std::to_string(highest + 1LL) + ", the file has " +
          std::to_string(mesh.points.size()));
  }
  for (const Face &one : faces)
    add_polygon(one.corners, mesh);
  return mesh;
}
} // namespace dem::detail
