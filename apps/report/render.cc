#include "report/render.h"

#include "report/egl_window.h"

#include <vtkActor.h>
#include <vtkBoundingBox.h>
#include <vtkCamera.h>
#include <vtkCellData.h>
#include <vtkColorTransferFunction.h>
#include <vtkDataArray.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkLight.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkRenderStepsPass.h>
#include <vtkRenderer.h>
#include <vtkSSAOPass.h>
#include <vtkScalarBarActor.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkWindowToImageFilter.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

namespace spall
{
namespace
{
namespace fs = std::filesystem;

constexpr int panel = 900, bar_panel = 220; ///< [px]
constexpr int fineness = 2; ///< of the drawing against the picture

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

/// Without cells if the file cannot be read: the caller says so.
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

/// From the grey of an unbroken stone over orange to dark red.
vtkNew<vtkLookupTable> loss_colours(double max_loss)
{
  vtkNew<vtkColorTransferFunction> ramp;
  ramp->SetColorSpaceToLab();
  ramp->AddRGBPoint(0., 0.86, 0.85, 0.82);
  ramp->AddRGBPoint(0.3, 0.96, 0.76, 0.45);
  ramp->AddRGBPoint(0.6, 0.87, 0.39, 0.20);
  ramp->AddRGBPoint(1., 0.40, 0.02, 0.15);
  vtkNew<vtkLookupTable> table;
  constexpr int n = 256;
  table->SetNumberOfTableValues(n);
  for (int k = 0; k < n; ++k)
  {
    double rgb[3];
    ramp->GetColor(k / (n - 1.), rgb);
    table->SetTableValue(k, rgb[0], rgb[1], rgb[2]);
  }
  table->SetRange(0., 100. * max_loss);
  return table;
}

/// Adds the loss in per cent, which the bar shows.
void add_percent(vtkPolyData *faces)
{
  vtkDataArray *loss = faces->GetCellData()->GetArray("loss_1");
  vtkNew<vtkFloatArray> percent;
  percent->SetName("loss_percent");
  percent->SetNumberOfTuples(faces->GetNumberOfCells());
  for (vtkIdType k = 0; k < faces->GetNumberOfCells(); ++k)
    percent->SetValue(k, loss ? 100.f * static_cast<float>(loss->GetTuple1(k))
                              : 0.f);
  faces->GetCellData()->SetScalars(percent);
}

void add_stones(vtkRenderer *renderer, vtkPolyData *faces,
                vtkLookupTable *colours)
{
  add_percent(faces);
  vtkNew<vtkPolyDataNormals> smooth;
  smooth->SetInputData(faces);
  smooth->SplittingOff();
  smooth->ConsistencyOff();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(smooth->GetOutputPort());
  mapper->SetScalarModeToUseCellData();
  mapper->SetLookupTable(colours);
  mapper->UseLookupTableScalarRangeOn();
  vtkNew<vtkActor> stones;
  stones->SetMapper(mapper);
  stones->GetProperty()->SetAmbient(0.18);
  stones->GetProperty()->SetDiffuse(0.85);
  stones->GetProperty()->SetSpecular(0.06);
  stones->GetProperty()->SetSpecularPower(12.);
  renderer->AddActor(stones);
}

void add_membrane(vtkRenderer *renderer, const std::string &path)
{
  const vtkNew<vtkPolyData> faces = read_faces(path);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(faces);
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> sheet, mesh;
  sheet->SetMapper(mapper);
  sheet->GetProperty()->SetColor(0.45, 0.65, 0.85);
  sheet->GetProperty()->SetOpacity(0.14);
  sheet->GetProperty()->SetAmbient(0.6);
  sheet->GetProperty()->SetDiffuse(0.4);
  mesh->SetMapper(mapper);
  mesh->GetProperty()->SetRepresentationToWireframe();
  mesh->GetProperty()->SetColor(0.18, 0.33, 0.5);
  mesh->GetProperty()->SetOpacity(0.35);
  mesh->GetProperty()->LightingOff();
  mesh->GetProperty()->SetLineWidth(fineness);
  renderer->AddActor(sheet);
  renderer->AddActor(mesh);
}

void add_title(vtkRenderer *renderer, const std::string &title)
{
  vtkNew<vtkTextActor> text;
  text->SetInput(title.c_str());
  text->GetTextProperty()->SetFontSize(fineness * 30);
  text->GetTextProperty()->SetColor(0.15, 0.15, 0.15);
  text->GetTextProperty()->SetJustificationToCentered();
  text->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  text->SetPosition(0.5, 0.955);
  renderer->AddViewProp(text);
}

/// One light from the upper left, a weak one from the right.
void add_lights(vtkRenderer *renderer)
{
  const auto add = [&](double x, double y, double z, double strength)
  {
    vtkNew<vtkLight> light;
    light->SetLightTypeToCameraLight();
    light->SetPosition(x, y, z);
    light->SetFocalPoint(0., 0., 0.);
    light->SetIntensity(strength);
    renderer->AddLight(light);
  };
  renderer->AutomaticLightCreationOff();
  add(-0.7, 1., 0.9, 0.85);
  add(1., 0.1, 0.8, 0.35);
}

/// Darkens the gaps between stones, which gives the picture its depth.
void add_depth(vtkRenderer *renderer, const vtkBoundingBox &box)
{
  vtkNew<vtkRenderStepsPass> steps;
  vtkNew<vtkSSAOPass> shade;
  shade->SetRadius(0.06 * box.GetDiagonalLength());
  shade->SetBias(0.0005 * box.GetDiagonalLength());
  shade->SetKernelSize(32);
  shade->BlurOn();
  shade->SetDelegatePass(steps);
  renderer->SetPass(shade);
}

/// The same eye for every panel: three quarters from above.
void aim(vtkRenderer *renderer, const vtkBoundingBox &box)
{
  double centre[3];
  box.GetCenter(centre);
  vtkCamera *camera = renderer->GetActiveCamera();
  camera->SetFocalPoint(centre);
  camera->SetPosition(centre[0] + 0.62, centre[1] - 1., centre[2] + 0.48);
  camera->SetViewUp(0., 0., 1.);
  camera->SetViewAngle(24.);
  double bounds[6];
  box.GetBounds(bounds);
  renderer->ResetCamera(bounds);
  camera->Zoom(1.15);
  renderer->ResetCameraClippingRange();
}

void add_bar(vtkRenderer *renderer, vtkLookupTable *colours)
{
  vtkNew<vtkScalarBarActor> bar;
  bar->SetLookupTable(colours);
  bar->SetTitle("Loss of\nmass (%)\n");
  bar->SetNumberOfLabels(6);
  bar->SetLabelFormat("%.2g");
  bar->UnconstrainedFontSizeOn();
  for (vtkTextProperty *text :
       {bar->GetTitleTextProperty(), bar->GetLabelTextProperty()})
  {
    text->SetColor(0.15, 0.15, 0.15);
    text->ItalicOff();
    text->BoldOff();
    text->ShadowOff();
    text->SetFontSize(fineness * 26);
  }
  bar->SetBarRatio(0.22);
  bar->GetPositionCoordinate()->SetValue(0.05, 0.2);
  bar->GetPosition2Coordinate()->SetValue(0.9, 0.6);
  renderer->AddViewProp(bar);
}

/// One row of panels, each drawn finer than shown and averaged: the passes of
/// VTK neither share a window nor smooth the edges of translucent faces.
class Sheet
{
public:
  explicit Sheet(int width)
  {
    image->SetDimensions(width, panel, 1);
    image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  }

  void add(EglWindow *window, vtkRenderer *renderer, int width)
  {
    window->SetSize(fineness * width, fineness * panel);
    window->AddRenderer(renderer);
    window->Render();
    vtkNew<vtkWindowToImageFilter> grab;
    grab->SetInput(window);
    grab->ReadFrontBufferOff();
    grab->Update();
    copy(grab->GetOutput(), width);
    window->RemoveRenderer(renderer);
    next += width;
  }

  std::string png() const
  {
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputData(image);
    writer->WriteToMemoryOn();
    writer->Write();
    vtkUnsignedCharArray *bytes = writer->GetResult();
    return {reinterpret_cast<const char *>(bytes->GetPointer(0)),
            static_cast<std::size_t>(bytes->GetNumberOfValues())};
  }

private:
  void copy(vtkImageData *fine, int width)
  {
    for (int y = 0; y < panel; ++y)
      for (int x = 0; x < width; ++x)
        for (int i = 0; i < 3; ++i)
        {
          int sum = 0;
          for (int k = 0; k < fineness * fineness; ++k)
            sum += pixel(fine, fineness * x + k % fineness,
                         fineness * y + k / fineness)[i];
          pixel(image, next + x, y)[i] =
              static_cast<unsigned char>(sum / (fineness * fineness));
        }
  }

  static unsigned char *pixel(vtkImageData *from, int x, int y)
  {
    return static_cast<unsigned char *>(from->GetScalarPointer(x, y, 0));
  }

  vtkNew<vtkImageData> image;
  int next = 0; ///< first free column [px]
};

vtkNew<vtkRenderer> white_renderer()
{
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1., 1., 1.);
  return renderer;
}

vtkNew<vtkRenderer> specimen_renderer(const SpecimenFiles &specimen,
                                      vtkPolyData *faces,
                                      vtkLookupTable *colours)
{
  vtkNew<vtkRenderer> renderer = white_renderer();
  add_stones(renderer, faces, colours);
  if (!specimen.membrane.empty())
    add_membrane(renderer, specimen.membrane);
  add_lights(renderer);
  add_title(renderer, specimen.title);
  return renderer;
}
} // namespace

std::vector<SpecimenFiles> find_specimens(const std::string &folder)
{
  const fs::path frames = fs::path(folder) / "frames";
  const auto surfaces = frames_of(frames, "surfaces"),
             membranes = frames_of(frames, "membrane");
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

Picture render_specimens(std::span<const SpecimenFiles> specimens,
                         double max_loss)
{
  vtkNew<EglWindow> window;
  if (!window->open())
    return {"", "this machine offers no EGL to draw with."};
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  const vtkNew<vtkLookupTable> colours = loss_colours(max_loss);
  vtkBoundingBox box;
  std::vector<vtkNew<vtkPolyData>> faces;
  for (const SpecimenFiles &specimen : specimens)
  {
    faces.push_back(read_faces(specimen.surfaces));
    if (faces.back()->GetNumberOfCells() == 0)
      return {"", specimen.surfaces + " cannot be read or has no stones."};
    box.AddBounds(faces.back()->GetBounds());
    if (!specimen.membrane.empty())
      box.AddBounds(read_faces(specimen.membrane)->GetBounds());
  }
  Sheet sheet(static_cast<int>(specimens.size()) * panel + bar_panel);
  for (std::size_t k = 0; k < specimens.size(); ++k)
  {
    const vtkNew<vtkRenderer> renderer =
        specimen_renderer(specimens[k], faces[k], colours);
    aim(renderer, box);
    add_depth(renderer, box);
    sheet.add(window, renderer, panel);
  }
  const vtkNew<vtkRenderer> bar = white_renderer();
  add_bar(bar, colours);
  sheet.add(window, bar, bar_panel);
  return {sheet.png(), ""};
}
} // namespace spall
