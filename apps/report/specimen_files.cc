#include "report/specimen_files.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>

namespace spall
{
namespace
{
namespace fs = std::filesystem;

/// NAME_00012.vtu of a folder by number.
std::map<int, std::string> frames_of(const fs::path &folder,
                                     const std::string &name)
{
  std::map<int, std::string> files;
  if (!fs::is_directory(folder))
    return files;
  for (const auto &entry : fs::directory_iterator(folder))
  {
    const std::string stem = entry.path().stem().string();
    if (entry.path().extension() == ".vtu" && stem.starts_with(name + "_"))
      files[std::atoi(stem.c_str() + name.size() + 1)] = entry.path().string();
  }
  return files;
}

} // namespace

vtkNew<vtkPolyData> read_faces(const std::string &path)
{
  const int shows_warnings = vtkObject::GetGlobalWarningDisplay();
  vtkObject::GlobalWarningDisplayOff();
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkObject::SetGlobalWarningDisplay(shows_warnings);
  vtkUnstructuredGrid *grid = reader->GetOutput();
  vtkNew<vtkPolyData> faces;
  if (grid && grid->GetNumberOfCells() > 0)
  {
    faces->SetPoints(grid->GetPoints());
    faces->SetPolys(grid->GetCells());
    faces->GetCellData()->ShallowCopy(grid->GetCellData());
  }
  return faces;
}

std::vector<SpecimenFiles> find_specimens(const std::string &folder)
{
  const fs::path frames = fs::path(folder) / "frames";
  const auto surfaces = frames_of(frames, "surfaces"),
             tubes = frames_of(frames, "membrane"),
             // What stands round or on the stones.
      membranes = tubes.empty() ? frames_of(frames, "plate") : tubes;
  if (surfaces.empty())
    return {};
  const auto specimen = [&](const std::string &title, const auto &frame)
  {
    const auto membrane = membranes.find(frame.first);
    return SpecimenFiles{title, frame.second,
                         membrane == membranes.end() ? "" : membrane->second};
  };
  std::vector<SpecimenFiles> out{specimen("before loading", *surfaces.begin())};
  if (surfaces.size() > 1)
    out.push_back(specimen("after loading", *surfaces.rbegin()));
  return out;
}

double loss_scale(std::span<const SpecimenFiles> specimens)
{
  constexpr double smallest = 1e-5;
  if (specimens.empty())
    return smallest;
  const vtkNew<vtkPolyData> faces = read_faces(specimens.back().surfaces);
  vtkDataArray *loss = faces->GetCellData()->GetArray("loss_1");
  if (!loss || loss->GetNumberOfTuples() == 0)
    return smallest;
  std::vector<double> values(
      static_cast<std::size_t>(loss->GetNumberOfTuples()));
  for (std::size_t k = 0; k < values.size(); ++k)
    values[k] = loss->GetTuple1(static_cast<vtkIdType>(k));
  std::sort(values.begin(), values.end());
  // Stones have equally many triangles, so these are shares of stones.
  const double high = std::max(smallest, values[values.size() * 98 / 100]);
  const double decade = std::pow(10., std::floor(std::log10(high)));
  for (const double digit : {1., 2., 5.})
    if (high <= digit * decade * (1. + 1e-6))
      return digit * decade;
  return 10. * decade;
}

} // namespace spall
