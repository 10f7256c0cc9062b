#include "gmsh_file.h"

#include "gmsh_words.h"

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <stdexcept>
#include <unordered_map>

namespace fem
{
namespace
{
/// A type of elements in the numbers of gmsh.
struct ElementType
{
  const char *name;
  int order, n_nodes;
};

constexpr int line_type = 1, triangle_type = 2, quad_type = 3,
              hexahedron_type = 5, point_type = 15;

const ElementType *find_type(std::int64_t number)
{
  static const std::map<std::int64_t, ElementType> types = {
      {line_type, {"lines", 1, 2}},
      {triangle_type, {"triangles", 1, 3}},
      {quad_type, {"quads", 1, 4}},
      {4, {"tetrahedra", 1, 4}},
      {hexahedron_type, {"hexahedra", 1, 8}},
      {6, {"prisms", 1, 6}},
      {7, {"pyramids", 1, 5}},
      {8, {"lines", 2, 3}},
      {9, {"triangles", 2, 6}},
      {10, {"quads", 2, 9}},
      {11, {"tetrahedra", 2, 10}},
      {12, {"hexahedra", 2, 27}},
      {13, {"prisms", 2, 18}},
      {14, {"pyramids", 2, 14}},
      {point_type, {"points", 1, 1}},
      {16, {"quads", 2, 8}},
      {17, {"hexahedra", 2, 20}},
      {18, {"prisms", 2, 15}},
      {19, {"pyramids", 2, 13}},
      {21, {"triangles", 3, 10}},
      {23, {"triangles", 4, 15}},
      {26, {"lines", 3, 4}},
      {27, {"lines", 4, 5}},
      {29, {"tetrahedra", 3, 20}},
      {30, {"tetrahedra", 4, 35}},
      {36, {"quads", 3, 16}},
      {37, {"quads", 4, 25}},
      {92, {"hexahedra", 3, 64}},
      {93, {"hexahedra", 4, 125}}};
  const auto found = types.find(number);
  return found == types.end() ? nullptr : &found->second;
}

class Parser
{
public:
  explicit Parser(std::string_view text) : words(text) {}

  GmshMesh parse()
  {
    const std::string_view start = words.has_more() ? words.word() : "";
    if (start != "$MeshFormat" && start != "$NOD")
      words.refuse("does not begin with $MeshFormat");
    for (std::string section(start); !section.empty();
         section = words.has_more() ? std::string(words.word()) : "")
    {
      if (!section.starts_with('$'))
        words.refuse("must be a section, $Nodes or $Elements, a count may be "
                     "too small");
      take(section);
    }
    return std::move(mesh);
  }

private:
  void take(const std::string &section)
  {
    if (section == "$MeshFormat")
      take_format();
    else if (section == "$Entities" && version >= 4.)
      take_entities();
    else if (section == "$Nodes" || section == "$NOD")
      version < 4. ? take_nodes() : take_node_blocks();
    else if (section == "$Elements" || section == "$ELM")
      version < 4. ? take_elements() : take_element_blocks();
    else
      return skip(section);
    if (const std::string end = end_of(section); words.word() != end)
      words.refuse("must be " + end +
                   ": is a count of the section or a row of it wrong?");
  }

  static std::string end_of(const std::string &section)
  {
    return (section == "$NOD" || section == "$ELM" ? "$END" : "$End") +
           section.substr(1);
  }

  void skip(const std::string &section) { words.skip_past(end_of(section)); }

  void take_format()
  {
    version = words.number();
    if (!((version >= 2. && version < 3.) || (version >= 4. && version < 4.2)))
      words.refuse("format " + std::to_string(version).substr(0, 4) +
                   ": must be 2 or 4 (4.0, 4.1)");
    if (words.integer() != 0)
      words.refuse("is binary: save it as text (Mesh.Binary = 0)");
    words.integer(); // size of a number
  }

  /// Their physical groups.
  void take_entities()
  {
    std::array<std::int64_t, 4> n{};
    for (std::int64_t &one : n)
      one = words.count();
    for (std::size_t dim = 0; dim < 4; ++dim)
      for (std::int64_t k = 0; k < n[dim]; ++k)
      {
        const std::int64_t tag = words.integer();
        const int n_numbers = dim == 0 && version > 4. ? 3 : 6;
        for (int i = 0; i < n_numbers; ++i)
          words.number();
        take_groups(dim, tag);
        if (dim > 0)
          for (std::int64_t i = words.count(); i > 0; --i)
            words.integer();
      }
  }

  void take_groups(std::size_t dim, std::int64_t tag)
  {
    const std::int64_t n = words.count();
    if (n > 1 && dim == 3)
      words.refuse("a volume in " + std::to_string(n) +
                   " physical groups: must be in one");
    for (std::int64_t i = 0; i < n; ++i)
      if (const std::int32_t group = group_of(words.integer()); i == 0)
        groups[dim][tag] = group;
  }

  /// The sign is that of the side that it faces.
  std::int32_t group_of(std::int64_t number) const
  {
    if (std::abs(number) > std::numeric_limits<std::int32_t>::max())
      words.refuse("physical group " + std::to_string(number) +
                   ": must be at most 2147483647");
    return static_cast<std::int32_t>(std::abs(number));
  }

  void add_node(std::int64_t tag, const Eigen::Vector3d &x)
  {
    const auto next = static_cast<std::int32_t>(mesh.nodes.size());
    if (!number_of.emplace(tag, next).second)
      words.refuse("node " + std::to_string(tag) + " is given twice");
    mesh.nodes.push_back(x);
  }

  Eigen::Vector3d point()
  {
    Eigen::Vector3d x;
    for (double &one : x)
      one = words.number();
    return x;
  }

  void take_nodes()
  {
    const std::int64_t n = words.count();
    for (std::int64_t k = 0; k < n; ++k)
    {
      const std::int64_t tag = words.integer();
      add_node(tag, point());
    }
  }

  /// Format 4.0 has the tag before the dimension, and each node's before it.
  void take_node_blocks()
  {
    const bool is_old = version < 4.1;
    const std::int64_t n_blocks = words.count();
    for (int i = is_old ? 1 : 3; i > 0; --i) // number of all, range of tags
      words.integer();
    for (std::int64_t block = 0; block < n_blocks; ++block)
    {
      const std::int64_t first = words.integer(), second = words.integer();
      const std::int64_t dim = is_old ? second : first;
      if (dim < 0 || dim > 3)
        words.refuse("dimension " + std::to_string(dim) + ": must be 0 to 3");
      const std::int64_t n_more = words.integer() != 0 ? dim : 0;
      take_block(words.count(), n_more, is_old);
    }
  }

  /// `n_more` numbers follow every point.
  void take_block(std::int64_t n, std::int64_t n_more, bool is_old)
  {
    std::vector<std::int64_t> tags;
    for (std::int64_t k = 0; k < n && !is_old; ++k)
      tags.push_back(words.integer());
    for (std::int64_t k = 0; k < n; ++k)
    {
      const std::int64_t tag =
          is_old ? words.integer() : tags[static_cast<std::size_t>(k)];
      add_node(tag, point());
      for (std::int64_t i = 0; i < n_more; ++i)
        words.number();
    }
  }

  const ElementType &checked(std::int64_t type) const
  {
    const ElementType *of = find_type(type);
    if (of == nullptr)
      words.refuse("elements of type " + std::to_string(type) +
                   " are unknown: must be of order 1");
    if (of->order > 1)
      words.refuse("has " + std::string(of->name) + " of order " +
                   std::to_string(of->order) + " (" +
                   std::to_string(of->n_nodes) +
                   " nodes each): must be of order 1 (Mesh.ElementOrder = 1)");
    return *of;
  }

  template <std::size_t n>
  void take_cell(std::int32_t group, std::vector<GmshCell<n>> &cells)
  {
    GmshCell<n> &cell = cells.emplace_back();
    cell.physical = group;
    for (std::size_t v = 0; v < n; ++v)
    {
      const std::int64_t tag = words.integer();
      const auto found = number_of.find(tag);
      if (found == number_of.end())
        words.refuse("a cell names node " + std::to_string(tag) +
                     ", which is not there");
      cell.corners[v] = found->second;
      for (std::size_t w = 0; w < v; ++w)
        if (cell.corners[w] == cell.corners[v])
          words.refuse("a cell names node " + std::to_string(tag) + " twice");
    }
  }

  void take_element(std::int64_t type, const ElementType &of,
                    std::int32_t group)
  {
    if (type == triangle_type)
      return take_cell(group, mesh.triangles);
    if (type == quad_type)
      return take_cell(group, mesh.quads);
    if (type == hexahedron_type)
      return take_cell(group, mesh.hexahedra);
    if (type != line_type && type != point_type)
      mesh.other_cell = of.name;
    for (int i = 0; i < of.n_nodes; ++i)
      words.integer();
  }

  /// The first tag of an element is its physical group. Format 1 has two tags
  /// and the number of nodes.
  void take_elements()
  {
    const std::int64_t n = words.count();
    for (std::int64_t k = 0; k < n; ++k)
    {
      words.integer(); // number of the element
      const std::int64_t type = words.integer();
      const ElementType &of = checked(type);
      const std::int64_t n_tags = version < 2. ? 3 : words.count();
      std::int32_t group = 0;
      for (std::int64_t i = 0; i < n_tags; ++i)
        if (const std::int64_t tag = words.integer(); i == 0)
          group = group_of(tag);
      take_element(type, of, group);
    }
  }

  void take_element_blocks()
  {
    const bool is_old = version < 4.1;
    const std::int64_t n_blocks = words.count();
    for (int i = is_old ? 1 : 3; i > 0; --i)
      words.integer();
    for (std::int64_t block = 0; block < n_blocks; ++block)
    {
      const std::int64_t first = words.integer(), second = words.integer();
      const std::int64_t dim = is_old ? second : first;
      const std::int64_t tag = is_old ? first : second;
      if (dim < 0 || dim > 3)
        words.refuse("dimension " + std::to_string(dim) + ": must be 0 to 3");
      const auto &known = groups[static_cast<std::size_t>(dim)];
      const auto group = known.find(tag);
      const std::int64_t type = words.integer();
      const ElementType &of = checked(type);
      for (std::int64_t n = words.count(); n > 0; --n)
      {
        words.integer(); // number of the element
        take_element(type, of, group == known.end() ? 0 : group->second);
      }
    }
  }

  GmshWords words;
  GmshMesh mesh;
  double version = 1.;
  std::unordered_map<std::int64_t, std::int32_t> number_of;   ///< by tag
  std::array<std::map<std::int64_t, std::int32_t>, 4> groups; ///< by entity
};
} // namespace

GmshMesh parse_gmsh(std::string_view text)
{
  return Parser(text).parse();
}

GmshMesh read_gmsh(const std::string &path)
{
  std::ifstream file(path, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(file)),
                         std::istreambuf_iterator<char>());
  return parse_gmsh(text);
}
} // namespace fem
