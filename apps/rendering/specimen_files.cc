#include "rendering/specimen_files.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkXMLPUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace spall
{
namespace
{
namespace fs = std::filesystem;

/// The cells of a file, faces or lines as `add` puts them in.
template <class Add>
vtkNew<vtkPolyData> read_cells(const std::string &path, const Add &add)
{
  vtkNew<vtkUnstructuredGrid> grid;
  read_grid(path, grid);
  vtkNew<vtkPolyData> cells;
  if (grid->GetNumberOfCells() > 0)
  {
    cells->SetPoints(grid->GetPoints());
    add(cells, grid->GetCells());
    cells->GetCellData()->ShallowCopy(grid->GetCellData());
    cells->GetPointData()->ShallowCopy(grid->GetPointData());
  }
  return cells;
}
} // namespace

std::map<int, std::string> frames_of(const std::string &folder,
                                     const std::string &name)
{
  std::map<int, std::string> files;
  const fs::path frames = fs::path(folder) / "frames";
  if (!fs::is_directory(frames))
    return files;
  for (const auto &entry : fs::directory_iterator(frames))
  {
    const std::string file = entry.path().filename().string();
    if (!file.starts_with(name + "_"))
      continue;
    // A piece has its rank after the number: its index is the frame.
    const std::string number = file.substr(name.size() + 1);
    const std::size_t end = number.find_first_not_of("0123456789");
    if (end == std::string::npos || end == 0)
      continue;
    const std::string ending = number.substr(end);
    if (ending == ".vtu" || ending == ".pvtu")
      files[std::atoi(number.c_str())] = entry.path().string();
  }
  return files;
}

std::map<int, double> frame_times(const std::string &folder)
{
  std::map<int, double> times;
  std::ifstream list(fs::path(folder) / "run.pvd");
  for (std::string line; std::getline(list, line);)
  {
    const std::size_t time = line.find("timestep=\""), number = line.rfind('_');
    if (time != std::string::npos && number != std::string::npos)
      times[std::atoi(line.c_str() + number + 1)] =
          std::atof(line.c_str() + time + std::strlen("timestep=\""));
  }
  return times;
}

void read_grid(const std::string &path, vtkUnstructuredGrid *grid)
{
  const int shows_warnings = vtkObject::GetGlobalWarningDisplay();
  vtkObject::GlobalWarningDisplayOff();
  const auto read = [&](auto reader)
  {
    reader->SetFileName(path.c_str());
    reader->Update();
    if (reader->GetOutput())
      grid->ShallowCopy(reader->GetOutput());
  };
  if (path.ends_with(".pvtu"))
    read(vtkNew<vtkXMLPUnstructuredGridReader>().Get());
  else
    read(vtkNew<vtkXMLUnstructuredGridReader>().Get());
  vtkObject::SetGlobalWarningDisplay(shows_warnings);
}

vtkNew<vtkPolyData> read_faces(const std::string &path)
{
  return read_cells(path, [](vtkPolyData *faces, vtkCellArray *cells)
                    { faces->SetPolys(cells); });
}

vtkNew<vtkPolyData> read_lines(const std::string &path)
{
  return read_cells(path, [](vtkPolyData *lines, vtkCellArray *cells)
                    { lines->SetLines(cells); });
}

std::vector<SpecimenFiles> find_specimens(const std::string &folder)
{
  const auto surfaces = frames_of(folder, "surfaces");
  std::map<int, std::string> sheets; // what stands round or on the particles
  for (const char *name : {"membrane", "plate", "drum"})
    if (sheets.empty())
      sheets = frames_of(folder, name);
  if (surfaces.empty())
    return {};
  const auto specimen = [&](const std::string &title, const auto &frame)
  {
    const auto sheet = sheets.find(frame.first);
    return SpecimenFiles{title, frame.second,
                         sheet == sheets.end() ? "" : sheet->second};
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
  // Particles have equally many triangles, so these are shares of particles.
  const double high = std::max(smallest, values[values.size() * 98 / 100]);
  const double decade = std::pow(10., std::floor(std::log10(high)));
  for (const double digit : {1., 2., 5.})
    if (high <= digit * decade * (1. + 1e-6))
      return digit * decade;
  return 10. * decade;
}

} // namespace spall
