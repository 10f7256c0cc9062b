#include "stl_reader.h"

#include "text_lines.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace dem::detail
{
namespace
{
/// Of a binary file: before its triangles, and of each of them [bytes].
constexpr std::size_t header = 84, record = 50;

[[noreturn]] void fail(const std::string &what)
{
  throw std::invalid_argument(what);
}

/// Little endian, as the format has it.
std::uint32_t word_at(std::string_view bytes, std::size_t offset)
{
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < 4; ++k)
    value |= std::uint32_t(static_cast<unsigned char>(bytes[offset + k]))
             << (8 * k);
  return value;
}

TriangleMesh read_binary(std::string_view bytes)
{
  const std::size_t promised = word_at(bytes, header - 4);
  const std::size_t found = (bytes.size() - header) / record;
  if (promised != found)
    fail("its header promises " + std::to_string(promised) +
         " triangles, the file of " + std::to_string(bytes.size()) +
         " bytes has room for " + std::to_string(found) +
         (promised > found ? ": is it cut off?" : ""));
  TriangleMesh mesh;
  for (std::size_t t = 0; t < found; ++t)
  {
    for (std::size_t v = 0; v < 3; ++v)
    {
      Vec3 &point = mesh.points.emplace_back();
      for (std::size_t d = 0; d < 3; ++d)
        point[Eigen::Index(d)] = double(std::bit_cast<float>(
            word_at(bytes, header + t * record + 12 * (v + 1) + 4 * d)));
      if (!point.allFinite())
        fail("triangle " + std::to_string(t + 1) +
             " has a coordinate that is not a number");
    }
    const auto first = std::int32_t(3 * t);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

/// A text from `solid` to `endsolid`, once or more.
class TextScanner
{
public:
  explicit TextScanner(std::string_view text)
      : lines(text), last_line(1 + std::count(text.begin(), text.end(), '\n'))
  {
  }

  TriangleMesh read()
  {
    while (lines.next())
      take();
    if (is_in_solid)
      fail("ends after line " + std::to_string(lines.number()) +
           " without endsolid, " + std::to_string(mesh.triangles.size()) +
           " triangles: is it cut off?");
    return std::move(mesh);
  }

private:
  void take()
  {
    const std::string &word = lines.keyword();
    if (word.empty() || word == "color")
      return;
    if (is_in_solid == (word == "solid"))
      lines.refuse(is_in_solid ? "solid inside a solid: is an endsolid missing?"
                               : "must be solid and a name");
    if (word == "solid")
      is_in_solid = true;
    else if (word == "vertex")
      add_point();
    else if (word == "endfacet")
      add_triangle();
    else if (word == "endsolid")
      is_in_solid = false;
    else if (is_in_solid && lines.number() == last_line)
      return; // half a word, where the file is cut off
    else if (word != "facet" && word != "outer" && word != "endloop")
      lines.refuse("must be facet, outer loop, vertex, endloop, endfacet or "
                   "endsolid");
    if (word != "vertex" && word != "endloop" && n_corners > 0)
      lines.refuse("follows " + std::to_string(n_corners) +
                   " corners of a facet: must be three and endfacet");
  }

  void add_point()
  {
    double x[3];
    lines.numbers(x, "vertex and three numbers");
    mesh.points.emplace_back(x[0], x[1], x[2]);
    ++n_corners;
  }

  void add_triangle()
  {
    if (n_corners != 3)
      lines.refuse("a facet of " + std::to_string(n_corners) +
                   " corners: must be three");
    n_corners = 0;
    const auto next = std::int32_t(mesh.points.size());
    mesh.triangles.push_back({next - 3, next - 2, next - 1});
  }

  TextLines lines;
  std::ptrdiff_t last_line = 0; ///< number, without a line break at its end
  TriangleMesh mesh;
  int n_corners = 0; ///< of the facet that is open
  bool is_in_solid = false;
};

/// Begins as a text does. Binary files may as well: their size tells.
bool begins_as_text(std::string_view bytes)
{
  TextLines lines(bytes.substr(0, 1000));
  while (lines.next())
    if (!lines.keyword().empty())
      return lines.keyword() == "solid";
  return false;
}

bool has_binary_size(std::string_view bytes)
{
  return bytes.size() >= header &&
         bytes.size() ==
             header + record * std::size_t(word_at(bytes, header - 4));
}
} // namespace

TriangleMesh read_stl(std::string_view bytes)
{
  if (has_binary_size(bytes))
    return read_binary(bytes);
  // A binary file that is cut off has zeros among its bytes, a text has none.
  if (begins_as_text(bytes) && bytes.find('\0') == std::string_view::npos)
    return TextScanner(bytes).read();
  if (bytes.size() < header)
    fail("is not an STL file: a text begins with solid, a binary file has " +
         std::to_string(header) + " bytes or more");
  return read_binary(bytes);
}
} // namespace dem::detail
