#include "rendering/render_network.h"

#include "rendering/egl_window.h"
#include "rendering/stage.h"

#include <vtkActor.h>
#include <vtkBoundingBox.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFloatArray.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkTubeFilter.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace spall
{
namespace
{
/// Thickest tube over the mean length of a contact, and the thinnest over that.
constexpr double thickest = 0.16, thinnest = 0.04;

/// Normal forces of the contacts of a frame [N].
std::vector<double> forces_of(const std::string &path)
{
  const vtkNew<vtkPolyData> lines = read_lines(path);
  vtkDataArray *force = lines->GetCellData()->GetArray("normal_force_N");
  std::vector<double> forces;
  for (vtkIdType k = 0; force && k < force->GetNumberOfTuples(); ++k)
    forces.push_back(force->GetTuple1(k));
  return forces;
}

double sum_of_forces(const std::string &path)
{
  double sum = 0.;
  for (const double force : forces_of(path))
    sum += force;
  return sum;
}

double mean_length(vtkPolyData *lines)
{
  const vtkIdType n = lines->GetNumberOfPoints() / 2;
  double sum = 0.;
  for (vtkIdType k = 0; k < n; ++k)
  {
    double from[3], to[3];
    lines->GetPoint(2 * k, from);
    lines->GetPoint(2 * k + 1, to);
    sum += std::hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]);
  }
  return n > 0 ? sum / static_cast<double>(n) : 0.;
}

/// Contacts that press, as tubes; the colours show the same as the thickness.
void add_tubes(vtkRenderer *renderer, vtkPolyData *lines,
               vtkLookupTable *colours)
{
  const double max_force = colours->GetRange()[1], length = mean_length(lines);
  vtkDataArray *force = lines->GetPointData()->GetArray("normal_force_N");
  vtkNew<vtkFloatArray> radius;
  radius->SetName("radius");
  radius->SetNumberOfTuples(lines->GetNumberOfPoints());
  for (vtkIdType k = 0; k < lines->GetNumberOfPoints(); ++k)
  {
    const double share = force->GetTuple1(k) / max_force;
    radius->SetValue(k, static_cast<float>(length * thickest *
                                           std::clamp(share, thinnest, 1.)));
  }
  lines->GetPointData()->AddArray(radius);
  lines->GetPointData()->SetActiveScalars("radius");
  vtkNew<vtkTubeFilter> tubes;
  tubes->SetInputData(lines);
  tubes->SetNumberOfSides(8);
  tubes->CappingOn();
  tubes->SetVaryRadiusToVaryRadiusByAbsoluteScalar();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(tubes->GetOutputPort());
  mapper->SetScalarModeToUsePointFieldData();
  mapper->SelectColorArray("normal_force_N");
  mapper->SetLookupTable(colours);
  mapper->UseLookupTableScalarRangeOn();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetAmbient(0.25);
  actor->GetProperty()->SetDiffuse(0.8);
  renderer->AddActor(actor);
}

/// Outward of where the membrane was put, from its axis [mm], by points; false
/// if the file has none.
bool add_bulge(vtkPolyData *faces)
{
  vtkDataArray *moved = faces->GetPointData()->GetArray("displacement_m");
  if (!moved || moved->GetNumberOfComponents() != 3)
    return false;
  vtkBoundingBox box;
  std::vector<std::array<double, 3>> start(
      static_cast<std::size_t>(faces->GetNumberOfPoints()));
  for (vtkIdType k = 0; k < faces->GetNumberOfPoints(); ++k)
  {
    auto &point = start[static_cast<std::size_t>(k)];
    faces->GetPoint(k, point.data());
    for (int d = 0; d < 3; ++d)
      point[static_cast<std::size_t>(d)] -= moved->GetComponent(k, d);
    box.AddPoint(point.data());
  }
  double axis[3];
  box.GetCenter(axis);
  vtkNew<vtkFloatArray> bulge;
  bulge->SetName("bulge_mm");
  bulge->SetNumberOfTuples(faces->GetNumberOfPoints());
  for (vtkIdType k = 0; k < faces->GetNumberOfPoints(); ++k)
  {
    const auto &point = start[static_cast<std::size_t>(k)];
    const double x = point[0] - axis[0], y = point[1] - axis[1];
    bulge->SetValue(k, static_cast<float>(1e3 *
                                          (moved->GetComponent(k, 0) * x +
                                           moved->GetComponent(k, 1) * y) /
                                          std::hypot(x, y)));
  }
  faces->GetPointData()->SetScalars(bulge);
  return true;
}

vtkNew<vtkLookupTable> force_colours(double max_force)
{
  return colour_table({{0., 0.80, 0.83, 0.86},
                       {0.25, 0.55, 0.70, 0.84},
                       {0.5, 0.95, 0.70, 0.35},
                       {1., 0.65, 0.05, 0.10}},
                      0., max_force);
}

/// Blue inward, red outward, white where it was put.
vtkNew<vtkLookupTable> bulge_colours(double max_bulge)
{
  return colour_table({{0., 0.13, 0.30, 0.60},
                       {0.25, 0.55, 0.72, 0.87},
                       {0.5, 0.95, 0.95, 0.94},
                       {0.75, 0.93, 0.62, 0.45},
                       {1., 0.60, 0.08, 0.12}},
                      -1e3 * max_bulge, 1e3 * max_bulge);
}

vtkNew<vtkRenderer> force_panel(const NetworkFiles &files, vtkPolyData *lines,
                                vtkLookupTable *colours)
{
  vtkNew<vtkRenderer> renderer = white_renderer();
  add_tubes(renderer, lines, colours);
  if (!files.membrane.empty())
    add_sheet(renderer, read_faces(files.membrane));
  add_lights(renderer);
  add_title(renderer, files.title);
  return renderer;
}

vtkNew<vtkRenderer> bulge_panel(vtkPolyData *faces, vtkLookupTable *colours)
{
  vtkNew<vtkRenderer> renderer = white_renderer();
  add_coloured_faces(renderer, faces, colours);
  add_lights(renderer);
  add_title(renderer, "membrane");
  return renderer;
}
} // namespace

std::vector<NetworkFiles> find_networks(const std::string &folder)
{
  const std::map<int, std::string> contacts = frames_of(folder, "contacts"),
                                   membranes = frames_of(folder, "membrane");
  if (contacts.empty())
    return {};
  const auto network = [&](const std::string &title, const auto &frame)
  {
    const auto membrane = membranes.find(frame.first);
    return NetworkFiles{title, frame.second,
                        membrane == membranes.end() ? "" : membrane->second};
  };
  std::vector<NetworkFiles> networks{
      network("contact forces, before loading", *contacts.begin())};
  if (contacts.size() == 1)
    return networks;
  // The last but one is half through the last cycle; some runs have their end
  // twice, some no frames but the first and the last.
  const auto last = contacts.rbegin(), first = std::prev(contacts.rend());
  auto most = last;
  double largest = -1.;
  int n_seen = 0;
  for (auto frame = last; frame != first && n_seen < 3; ++frame, ++n_seen)
    if (const double sum = sum_of_forces(frame->second); sum > largest)
    {
      largest = sum;
      most = frame;
    }
  networks.push_back(network(most == last ? "contact forces, after loading"
                                          : "contact forces, under load",
                             *most));
  return networks;
}

double force_scale(std::span<const NetworkFiles> networks)
{
  std::vector<double> forces;
  for (const NetworkFiles &network : networks)
  {
    const std::vector<double> some = forces_of(network.contacts);
    forces.insert(forces.end(), some.begin(), some.end());
  }
  if (forces.empty())
    return 0.;
  std::ranges::sort(forces);
  return forces[forces.size() * 99 / 100];
}

double bulge_scale(std::span<const NetworkFiles> networks)
{
  if (networks.empty() || networks.back().membrane.empty())
    return 0.;
  const vtkNew<vtkPolyData> faces = read_faces(networks.back().membrane);
  if (!add_bulge(faces))
    return 0.;
  const double *range = faces->GetPointData()->GetScalars()->GetRange();
  return 1e-3 * std::max(std::abs(range[0]), std::abs(range[1]));
}

Picture render_network(std::span<const NetworkFiles> networks, double max_force,
                       double max_bulge)
{
  vtkNew<EglWindow> window;
  if (!window->open())
    return {"", "this machine offers no EGL to draw with."};
  if (max_force <= 0.)
    return {"", "nothing touches."};
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  Shapes lines, seen;
  for (const NetworkFiles &files : networks)
  {
    lines.push_back(read_lines(files.contacts));
    if (lines.back()->GetNumberOfCells() == 0)
      return {"", files.contacts + " cannot be read or has no contacts."};
    seen.emplace_back()->ShallowCopy(lines.back());
    if (!files.membrane.empty())
      seen.push_back(read_faces(files.membrane));
  }
  const vtkNew<vtkCamera> camera = aim(seen);
  const vtkNew<vtkPolyData> faces = read_faces(networks.back().membrane);
  const bool has_bulge = max_bulge > 0. && add_bulge(faces);
  const int n_panels = static_cast<int>(networks.size()) + has_bulge;
  const int width = n_panels * panel_width + (1 + has_bulge) * bar_width;
  PictureSheet sheet(width, panel_width);
  const vtkNew<vtkLookupTable> colours = force_colours(max_force);
  for (std::size_t k = 0; k < networks.size(); ++k)
    add_panel(sheet, window, force_panel(networks[k], lines[k], colours),
              camera);
  add_bar_panel(sheet, window, colours, "Normal\nforce (N)\n");
  if (has_bulge)
  {
    const vtkNew<vtkLookupTable> of_bulge = bulge_colours(max_bulge);
    add_panel(sheet, window, bulge_panel(faces, of_bulge), camera);
    add_bar_panel(sheet, window, of_bulge, "Outward\n(mm)\n");
  }
  return {sheet.png(), "", width};
}
} // namespace spall
