#include "obj_reader.h"
#include "ply_reader.h"
#include "stl_reader.h"

#include <dem/io/mesh_reader.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace dem
{
namespace
{
[[noreturn]] void fail(const std::string &path, const std::string &what)
{
  throw std::invalid_argument(path + ": " + what);
}

std::string contents_of(const std::string &path)
{
  if (!std::filesystem::exists(path))
    fail(path, "no such file");
  std::ifstream in(path, std::ios::binary);
  if (!std::filesystem::is_regular_file(path) || !in)
    fail(path, "cannot be read");
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

MeshFormat format_of(const std::string &path)
{
  std::string ending = std::filesystem::path(path).extension().string();
  std::ranges::transform(ending, ending.begin(),
                         [](unsigned char c) { return char(std::tolower(c)); });
  if (ending == ".stl")
    return MeshFormat::stl;
  if (ending == ".ply")
    return MeshFormat::ply;
  if (ending == ".obj")
    return MeshFormat::obj;
  fail(path, "unknown ending \"" + ending + "\", must be .stl, .ply or .obj");
}
} // namespace

TriangleMesh parse_mesh(std::string_view bytes, MeshFormat format)
{
  TriangleMesh mesh = format == MeshFormat::stl   ? detail::read_stl(bytes)
                      : format == MeshFormat::ply ? detail::read_ply(bytes)
                                                  : detail::read_obj(bytes);
  if (mesh.triangles.empty())
    throw std::invalid_argument("no triangles could be read");
  return mesh;
}

TriangleMesh read_mesh(const std::string &path)
{
  const std::string bytes = contents_of(path);
  const MeshFormat format = format_of(path);
  try
  {
    return parse_mesh(bytes, format);
  }
  catch (const std::invalid_argument &error)
  {
    fail(path, error.what());
  }
}
} // namespace dem
