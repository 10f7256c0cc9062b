#include "ply_reader.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
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
  const std::string &text;
  std::size_t place = 0;
};

std::string next_line(Cursor &cursor)
{
  if (cursor.place >= cursor.text.size())
    fail("ends within its header");
  const std::size_t end =
      std::min(cursor.text.find('\n', cursor.place), cursor.text.size());
  std::string line = cursor.text.substr(cursor.place, end - cursor.place);
  cursor.place = end + 1;
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
  if (cursor.text.size() - cursor.place < sizeof bytes)
    fail("ends before its last triangle");
  std::memcpy(bytes, cursor.text.data() + cursor.place, sizeof bytes);
  cursor.place += sizeof bytes;
  if (is_swapped)
    std::reverse(std::begin(bytes), std::end(bytes));
  Number number;
  std::memcpy(&number, bytes, sizeof number);
  return double(number);
}

double text_number(Cursor &cursor)
{
  const std::string &text = cursor.text;
  while (cursor.place < text.size() &&
         std::isspace(static_cast<unsigned char>(text[cursor.place])))
    ++cursor.place;
  if (cursor.place >= text.size())
    fail("ends before its last triangle");
  double value = 0.;
  const auto [stop, error] = std::from_chars(text.data() + cursor.place,
                                             text.data() + text.size(), value);
  if (error != std::errc())
    fail("has a word where a number should be");
  cursor.place = std::size_t(stop - text.data());
  return value;
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

std::int32_t point_number(double value)
{
  if (!(value >= 0. && value < 2147483647. && value == std::floor(value)))
    fail("has a face with no valid point number");
  return std::int32_t(value);
}

void add_fan(const std::vector<double> &corners, TriangleMesh &mesh)
{
  for (std::size_t i = 2; i < corners.size(); ++i)
    mesh.triangles.push_back({point_number(corners[0]),
                              point_number(corners[i - 1]),
                              point_number(corners[i])});
}

void read_entries(Cursor &cursor, const Header &header, const Element &element,
                  TriangleMesh &mesh)
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
        add_fan(numbers, mesh);
    }
    if (element.name == "vertex")
      mesh.points.push_back(point);
  }
}
} // namespace

TriangleMesh read_ply(const std::string &path)
{
  std::ifstream in(path, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(in)),
                         std::istreambuf_iterator<char>());
  Cursor cursor{text};
  const Header header = read_header(cursor);
  TriangleMesh mesh;
  for (const Element &element : header.elements)
    read_entries(cursor, header, element, mesh);
  const auto n_points = std::int32_t(mesh.points.size());
  for (const auto &triangle : mesh.triangles)
    if (*std::max_element(triangle.begin(), triangle.end()) >= n_points)
      fail("has a face with no valid point number");
  return mesh;
}
} // namespace dem::detail
