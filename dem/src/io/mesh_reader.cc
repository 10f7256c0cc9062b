#include "ply_reader.h"

#include <dem/io/mesh_reader.h>

#include <vtkCellArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkObject.h>
#include <vtkPolyData.h>
#include <vtkSTLReader.h>
#include <vtkTriangleFilter.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace dem
{
namespace
{
[[noreturn]] void fail(const std::string &path, const std::string &what)
{
  throw std::invalid_argument(path + ": " + what);
}

std::string ending_of(const std::string &path)
{
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return ending;
}

void require_readable(const std::string &path)
{
  if (!std::filesystem::exists(path))
    fail(path, "no such file");
  if (!std::filesystem::is_regular_file(path) || !std::ifstream(path))
    fail(path, "cannot be read");
}

/// VTK prints several lines of its own for a bad file; we say one.
class QuietVtk
{
public:
  QuietVtk() : before(vtkObject::GetGlobalWarningDisplay())
  {
    vtkObject::GlobalWarningDisplayOff();
  }
  ~QuietVtk() { vtkObject::SetGlobalWarningDisplay(before); }
  QuietVtk(const QuietVtk &) = delete;
  QuietVtk &operator=(const QuietVtk &) = delete;

private:
  const int before;
};

template <typename Reader>
vtkSmartPointer<vtkPolyData> read_with(const std::string &path)
{
  const QuietVtk quiet;
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  vtkNew<vtkTriangleFilter> triangles;
  triangles->PassLinesOff();
  triangles->PassVertsOff();
  triangles->SetInputConnection(reader->GetOutputPort());
  triangles->Update();
  return triangles->GetOutput();
}

TriangleMesh mesh_of(vtkPolyData &surface)
{
  TriangleMesh mesh;
  for (vtkIdType i = 0; i < surface.GetNumberOfPoints(); ++i)
  {
    double p[3];
    surface.GetPoint(i, p);
    mesh.points.emplace_back(p[0], p[1], p[2]);
  }
  vtkNew<vtkIdList> corners;
  vtkCellArray *cells = surface.GetPolys();
  for (cells->InitTraversal(); cells->GetNextCell(corners);)
    mesh.triangles.push_back({std::int32_t(corners->GetId(0)),
                              std::int32_t(corners->GetId(1)),
                              std::int32_t(corners->GetId(2))});
  return mesh;
}

/// The reader of VTK takes what is no number as 0.
void require_vertices(const std::string &path)
{
  std::ifstream in(path);
  int number = 0;
  for (std::string line; std::getline(in, line);)
  {
    ++number;
    std::istringstream fields(line);
    std::string word;
    if (!(fields >> word) || word != "v")
      continue;
    for (int d = 0; d < 3; ++d)
    {
      const bool is_there = static_cast<bool>(fields >> word);
      char *end = nullptr;
      const double value = std::strtod(word.c_str(), &end);
      if (!is_there || *end != '\0' || !std::isfinite(value))
        throw std::invalid_argument("line " + std::to_string(number) + ": \"" +
                                    line + "\": must be v and three numbers");
    }
  }
}

TriangleMesh read_by_ending(const std::string &path)
{
  const std::string ending = ending_of(path);
  if (ending == ".stl")
    return mesh_of(*read_with<vtkSTLReader>(path));
  if (ending == ".ply")
    return detail::read_ply(path);
  if (ending == ".obj")
  {
    require_vertices(path);
    return mesh_of(*read_with<vtkOBJReader>(path));
  }
  throw std::invalid_argument("unknown ending \"" + ending +
                              "\", must be .stl, .ply or .obj");
}
} // namespace

TriangleMesh read_mesh(const std::string &path)
{
  require_readable(path);
  TriangleMesh mesh;
  try
  {
    mesh = read_by_ending(path);
  }
  catch (const std::invalid_argument &error)
  {
    fail(path, error.what());
  }
  if (mesh.triangles.empty())
    fail(path, "no triangles could be read");
  return mesh;
}
} // namespace dem
