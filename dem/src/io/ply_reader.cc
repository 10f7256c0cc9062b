#include "ply_reader.h"

#include "number_text.h"
#include "polygon.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstring>
#include <iterator>
#include <map>
#include <sstream>
#include <stdexcept>

namespace dem::detail
{
namespace
{
enum class Kind
{
  int8,
  uint8,
  int16,
  uint16,
  int32,
  uint32,
  float32,
  float64
};

struct Property
{
  std::string name;
  Kind kind = Kind::float32;
  bool is_list = false;
  Kind count_kind = Kind::uint8; ///< of the length of a list
};

struct Element
{
  std::string name;
  long long count = 0;
  std::vector<Property> properties;
};

struct Header
{
  bool is_text = true;
  bool is_swapped = false; ///< byte order of the file is not ours
  std::vector<Element> elements;
};

[[noreturn]] void fail(const std::string &what)
{
  throw std::invalid_argument("PLY file " + what);
}

Kind kind_of(const std::string &name)
{
  static const std::map<std::string, Kind> kinds = {
      {"char", Kind::int8},      {"int8", Kind::int8},
      {"uchar", Kind::uint8},    {"uint8", Kind::uint8},
      {"short", Kind::int16},    {"int16", Kind::int16},
      {"ushort", Kind::uint16},  {"uint16", Kind::uint16},
      {"int", Kind::int32},      {"int32", Kind::int32},
      {"uint", Kind::uint32},    {"uint32", Kind::uint32},
      {"float", Kind::float32},  {"float32", Kind::float32},
      {"double", Kind::float64}, {"float64", Kind::float64}};
  const auto found = kinds.find(name);
  if (found == kinds.end())
    fail("has a property of unknown type \"" + name + "\"");
  return found->second;
}

/// The text of a file and how far it is read.
struct Cursor
{
  std::string_view text;
  std::size_t offset = 0;
};

std::string next_line(Cursor &cursor)
{
  if (cursor.offset >= cursor.text.size())
    fail("ends within its header");
  const std::size_t end =
      std::min(cursor.text.find('\n', cursor.offset), cursor.text.size());
  std::string line(cursor.text.substr(cursor.offset, end - cursor.offset));
  cursor.offset = std::min(end + 1, cursor.text.size());
  if (!line.empty() && line.back() == '\r')
    line.pop_back();
  return line;
}

void read_format(std::istringstream &words, Header &header)
{
  std::string format;
  words >> format;
  header.is_text = format == "ascii";
  const bool is_little = format == "binary_little_endian";
  if (!header.is_text && !is_little && format != "binary_big_endian")
    fail("has the unknown format \"" + format + "\"");
  header.is_swapped = !header.is_text &&
                      is_little != (std::endian::native == std::endian::little);
}

void read_element(std::istringstream &words, Header &header)
{
  Element element;
  if (!(words >> element.name >> element.count) || element.count < 0)
    fail("has an element without a number");
  header.elements.push_back(element);
}

void read_property(std::istringstream &words, Header &header)
{
  if (header.elements.empty())
    fail("has a property before any element");
  Property property;
  std::string type;
  words >> type;
  property.is_list = type == "list";
  if (property.is_list)
  {
    words >> type;
    property.count_kind = kind_of(type);
    words >> type;
  }
  property.kind = kind_of(type);
  words >> property.name;
  header.elements.back().properties.push_back(property);
}

Header read_header(Cursor &cursor)
{
  if (next_line(cursor) != "ply")
    fail("does not begin with \"ply\": no triangles");
  Header header;
  bool has_format = false;
  for (std::string line = next_line(cursor); line != "end_header";
       line = next_line(cursor))
  {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "format")
    {
      read_format(words, header);
      has_format = true;
    }
    else if (word == "element")
      read_element(words, header);
    else if (word == "property")
      read_property(words, header);
  }
  if (!has_format)
    fail("names no format");
  return header;
}

template <typename Number>
double binary_number(Cursor &cursor, bool is_swapped)
{
  char bytes[sizeof(Number)];
  if (cursor.text.size() - cursor.offset < sizeof bytes)
    fail("ends before its last triangle");
  std::memcpy(bytes, cursor.text.data() + cursor.offset, sizeof bytes);
  cursor.offset += sizeof bytes;
  if (is_swapped)
    std::reverse(std::begin(bytes), std::end(bytes));
  Number number;
  std::memcpy(&number, bytes, sizeof number);
  return double(number);
}

double text_number(Cursor &cursor)
{
  constexpr std::string_view blanks = " \t\r\n\v\f";
  const std::string_view text = cursor.text;
  cursor.offset = text.find_first_not_of(blanks, cursor.offset);
  if (cursor.offset >= text.size())
    fail("ends before its last triangle");
  const std::size_t end =
      std::min(text.find_first_of(blanks, cursor.offset), text.size());
  const std::string_view word = text.substr(cursor.offset, end - cursor.offset);
  const auto value = any_number_in(word);
  if (!value)
    fail("has a word where a number should be, line " +
         std::to_string(1 + std::count(text.begin(),
                                       text.begin() + long(cursor.offset),
                                       '\n')) +
         comma_hint(word));
  cursor.offset = end;
  return *value;
}

double next_number(Cursor &cursor, const Header &header, Kind kind)
{
  if (header.is_text)
    return text_number(cursor);
  switch (kind)
  {
  case Kind::int8:
    return binary_number<std::int8_t>(cursor, header.is_swapped);
  case Kind::uint8:
    return binary_number<std::uint8_t>(cursor, header.is_swapped);
  case Kind::int16:
    return binary_number<std::int16_t>(cursor, header.is_swapped);
  case Kind::uint16:
    return binary_number<std::uint16_t>(cursor, header.is_swapped);
  case Kind::int32:
    return binary_number<std::int32_t>(cursor, header.is_swapped);
  case Kind::uint32:
    return binary_number<std::uint32_t>(cursor, header.is_swapped);
  case Kind::float32:
    return binary_number<float>(cursor, header.is_swapped);
  case Kind::float64:
    return binary_number<double>(cursor, header.is_swapped);
  }
  return 0.;
}

/// Numbers of one property of one entry; one number if it is no list.
void read_numbers(Cursor &cursor, const Header &header,
                  const Property &property, std::vector<double> &numbers)
{
  double count = 1.;
  if (property.is_list)
    count = next_number(cursor, header, property.count_kind);
  if (!(count >= 0.))
    fail("has a list of negative length");
  numbers.clear();
  for (double i = 0.; i < count; ++i)
    numbers.push_back(next_number(cursor, header, property.kind));
}

/// The polygons of a file, for when all its points are known.
using Polygons = std::vector<std::vector<std::int32_t>>;

void add_polygon(const std::vector<double> &numbers, Polygons &polygons)
{
  if (numbers.size() < 3)
    return;
  if (numbers.size() > most_corners)
    fail("has a face of " + std::to_string(numbers.size()) +
         " corners, must be at most " + std::to_string(most_corners));
  std::vector<std::int32_t> &corners = polygons.emplace_back();
  for (const double value : numbers)
  {
    if (!(value >= 0. && value < 2147483647. && value == std::floor(value)))
      fail("has a face with no valid point number");
    corners.push_back(std::int32_t(value));
  }
}

struct Surface
{
  TriangleMesh mesh;
  Polygons polygons;
};

void read_entries(Cursor &cursor, const Header &header, const Element &element,
                  Surface &surface)
{
  std::vector<double> numbers;
  if (element.count > 0 && element.properties.empty())
    fail("has the element \"" + element.name + "\" without properties");
  for (long long i = 0; i < element.count; ++i)
  {
    Vec3 point = Vec3::Constant(std::nan(""));
    for (const Property &property : element.properties)
    {
      read_numbers(cursor, header, property, numbers);
      const std::string &name = property.name;
      if (name.size() == 1 && name[0] >= 'x' && name[0] <= 'z' &&
          numbers.size() == 1)
        point[name[0] - 'x'] = numbers[0];
      if (element.name == "face" &&
          (name == "vertex_indices" || name == "vertex_index"))
        add_polygon(numbers, surface.polygons);
    }
    if (element.name == "vertex" && !point.allFinite())
      fail("has a vertex without three finite numbers x, y and z");
    if (element.name == "vertex")
      surface.mesh.points.push_back(point);
  }
}
} // namespace

TriangleMesh read_ply(std::string_view bytes)
{
  Cursor cursor{bytes};
  const Header header = read_header(cursor);
  Surface surface;
  for (const Element &element : header.elements)
    read_entries(cursor, header, element, surface);
  const auto n_points = std::int32_t(surface.mesh.points.size());
  for (const auto &polygon : surface.polygons)
  {
    if (std::ranges::max(polygon) >= n_points)
      fail("has a face with no valid point number");
    add_polygon(polygon, surface.mesh);
  }
  return std::move(surface.mesh);
}
} // namespace dem::detail
