#include "rendering/render_ground.h"

#include "rendering/egl_window.h"
#include "rendering/stage.h"

#include <vtkActor.h>
#include <vtkCell.h>
#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkFloatArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace spall
{
namespace
{
/// The largest settlement as it is drawn, over the diagonal of the ground.
constexpr double drawn_settlement = 0.04;

using Nodes = std::vector<std::array<double, 3>>;

/// Cells with the positions of their nodes before any load and what they have
/// moved [m].
struct Ground
{
  vtkNew<vtkUnstructuredGrid> grid;
  Nodes rest, moved;
};

/// Without nodes if the file cannot be read or has no displacements.
void read_ground(const std::string &path, Ground &ground)
{
  read_grid(path, ground.grid);
  vtkDataArray *moved = ground.grid->GetPointData()->GetArray("displacement_m");
  if (!moved || moved->GetNumberOfComponents() != 3)
    return;
  // Surfaces are written where they are, solids where they were.
  const bool is_surface = ground.grid->GetCell(0)->GetCellDimension() == 2;
  for (vtkIdType k = 0; k < ground.grid->GetNumberOfPoints(); ++k)
  {
    auto &rest = ground.rest.emplace_back();
    auto &by = ground.moved.emplace_back();
    ground.grid->GetPoint(k, rest.data());
    for (int d = 0; d < 3; ++d)
    {
      by[static_cast<std::size_t>(d)] = moved->GetComponent(k, d);
      if (is_surface)
        rest[static_cast<std::size_t>(d)] -= moved->GetComponent(k, d);
    }
  }
}

/// What the nodes have moved since they had moved by `start`; empty if those
/// are of another mesh.
Nodes moved_since(const Nodes &start, const Ground &ground)
{
  if (start.size() != ground.moved.size())
    return {};
  Nodes since = ground.moved;
  for (std::size_t k = 0; k < since.size(); ++k)
    for (std::size_t d = 0; d < 3; ++d)
      since[k][d] -= start[k][d];
  return since;
}

Nodes start_of(const std::string &path)
{
  Ground ground;
  read_ground(path, ground);
  return ground.moved;
}

/// What the nodes of a frame have settled by at most [m].
double settlement_of(const Nodes &start, const std::string &frame)
{
  Ground ground;
  read_ground(frame, ground);
  double most = 0.;
  for (const auto &node : moved_since(start, ground))
    most = std::max(most, -node[2]);
  return most;
}

void add_polygon(vtkCell *face, vtkCellArray *polygons)
{
  polygons->InsertNextCell(face->GetNumberOfPoints());
  for (vtkIdType k = 0; k < face->GetNumberOfPoints(); ++k)
    polygons->InsertCellPoint(face->GetPointId(k));
}

/// Faces of the cells behind the middle in y, bent `times` times, with the
/// settlement [mm] by points.
vtkNew<vtkPolyData> bent_half(const Ground &ground, const Nodes &since,
                              double times)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> settlement;
  double low = 1e300, high = -1e300;
  for (std::size_t k = 0; k < since.size(); ++k)
  {
    const auto &rest = ground.rest[k];
    low = std::min(low, rest[1]);
    high = std::max(high, rest[1]);
    points->InsertNextPoint(rest[0] + times * since[k][0],
                            rest[1] + times * since[k][1],
                            rest[2] + times * since[k][2]);
    settlement->InsertNextValue(static_cast<float>(-1e3 * since[k][2]));
  }
  vtkNew<vtkCellArray> polygons;
  for (vtkIdType c = 0; c < ground.grid->GetNumberOfCells(); ++c)
  {
    vtkCell *cell = ground.grid->GetCell(c);
    double sum = 0.;
    for (vtkIdType k = 0; k < cell->GetNumberOfPoints(); ++k)
      sum += ground.rest[static_cast<std::size_t>(cell->GetPointId(k))][1];
    if (sum <
        0.5 * (low + high) * static_cast<double>(cell->GetNumberOfPoints()))
      continue;
    if (cell->GetCellDimension() == 2)
      add_polygon(cell, polygons);
    for (int f = 0; f < cell->GetNumberOfFaces(); ++f)
      add_polygon(cell->GetFace(f), polygons);
  }
  vtkNew<vtkPolyData> faces;
  faces->SetPoints(points);
  faces->SetPolys(polygons);
  faces->GetPointData()->SetScalars(settlement);
  return faces;
}

/// One of 1, 2, 5 in its decade, at most x.
double round_down(double x)
{
  const double decade = std::pow(10., std::floor(std::log10(x)));
  return decade * (x >= 5. * decade ? 5. : x >= 2. * decade ? 2. : 1.);
}

vtkNew<vtkLookupTable> settlement_colours(double max_settlement)
{
  return colour_table({{0., 0.96, 0.95, 0.91},
                       {0.25, 0.78, 0.84, 0.72},
                       {0.5, 0.35, 0.66, 0.68},
                       {1., 0.06, 0.18, 0.42}},
                      0., 1e3 * max_settlement);
}

vtkNew<vtkRenderer> ground_panel(const GroundFiles &files, vtkPolyData *faces,
                                 double times, vtkLookupTable *colours)
{
  vtkNew<vtkRenderer> renderer = white_renderer();
  add_coloured_faces(renderer, faces, colours);
  if (!files.plate.empty())
    add_sheet(renderer, read_faces(files.plate));
  add_lights(renderer);
  char title[120];
  std::snprintf(title, sizeof title, "%s, bent %g times", files.title.c_str(),
                times);
  add_title(renderer, title);
  return renderer;
}
} // namespace

std::vector<GroundFiles> find_grounds(const std::string &folder)
{
  const std::map<int, std::string> frames = frames_of(folder, "subgrade"),
                                   plates = frames_of(folder, "plate");
  if (frames.size() < 2)
    return {};
  const std::map<int, double> times = frame_times(folder);
  const auto ground = [&](const std::string &what, const auto &frame)
  {
    const auto plate = plates.find(frame.first);
    const auto from = times.find(frames.begin()->first),
               to = times.find(frame.first);
    char title[80] = "";
    if (from != times.end() && to != times.end())
      std::snprintf(title, sizeof title, " (%.4g s)",
                    to->second - from->second);
    return GroundFiles{what + title, frames.begin()->second, frame.second,
                       plate == plates.end() ? "" : plate->second};
  };
  const Nodes start = start_of(frames.begin()->second);
  auto most = frames.rbegin();
  double deepest = -1.;
  for (auto frame = frames.rbegin(); frame != frames.rend(); ++frame)
    if (const double settled = settlement_of(start, frame->second);
        settled > deepest)
    {
      deepest = settled;
      most = frame;
    }
  std::vector<GroundFiles> grounds{ground("subgrade, settled most", *most)};
  if (most != frames.rbegin())
    grounds.push_back(ground("subgrade, at the end", *frames.rbegin()));
  return grounds;
}

double settlement_scale(std::span<const GroundFiles> grounds)
{
  double most = 0.;
  for (const GroundFiles &files : grounds)
  {
    most = std::max(most, settlement_of(start_of(files.start), files.ground));
  }
  return most;
}

Picture render_ground(std::span<const GroundFiles> grounds,
                      double max_settlement)
{
  vtkNew<EglWindow> window;
  if (!window->open())
    return {"", "this machine offers no EGL to draw with."};
  if (max_settlement <= 0.)
    return {"", "the subgrade has not settled."};
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  Shapes halves;
  double times = 1.;
  for (const GroundFiles &files : grounds)
  {
    Ground ground;
    read_ground(files.ground, ground);
    const Nodes since = moved_since(start_of(files.start), ground);
    if (since.empty())
      return {"", files.ground + " cannot be read or is of another mesh."};
    times = std::max(1., round_down(drawn_settlement *
                                    ground.grid->GetLength() / max_settlement));
    halves.push_back(bent_half(ground, since, times));
  }
  const vtkNew<vtkCamera> camera = aim(halves);
  const int width = static_cast<int>(grounds.size()) * panel_width + bar_width;
  PictureSheet sheet(width, panel_width);
  const vtkNew<vtkLookupTable> colours = settlement_colours(max_settlement);
  for (std::size_t k = 0; k < grounds.size(); ++k)
    add_panel(sheet, window,
              ground_panel(grounds[k], halves[k], times, colours), camera);
  add_bar_panel(sheet, window, colours, "Settled\n(mm)\n");
  return {sheet.png(), "", width};
}
} // namespace spall
