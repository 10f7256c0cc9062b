#include "report/render.h"

#include "report/egl_window.h"
#include "report/picture_sheet.h"

#include <vtkActor.h>
#include <vtkBoundingBox.h>
#include <vtkCamera.h>
#include <vtkCellData.h>
#include <vtkColorTransferFunction.h>
#include <vtkDataArray.h>
#include <vtkFloatArray.h>
#include <vtkLight.h>
#include <vtkLookupTable.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
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

#include <algorithm>
#include <vector>

namespace spall
{
namespace
{
constexpr int panel = 900, bar_panel = 220; ///< [px]
constexpr int fineness = PictureSheet::fineness;

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
void add_depth(vtkRenderer *renderer, double size)
{
  vtkNew<vtkRenderStepsPass> steps;
  vtkNew<vtkSSAOPass> shade;
  shade->SetRadius(0.06 * size);
  shade->SetBias(0.002 * size);
  shade->SetKernelSize(32);
  shade->BlurOn();
  shade->SetDelegatePass(steps);
  renderer->SetPass(shade);
}

using Faces = std::vector<vtkNew<vtkPolyData>>;

vtkBoundingBox bounds_of(const Faces &all_faces)
{
  vtkBoundingBox box;
  for (const vtkNew<vtkPolyData> &faces : all_faces)
    box.AddBounds(faces->GetBounds());
  return box;
}

/// Zooms and shifts until the points fill the picture.
void fill(vtkCamera *camera, const Faces &all_faces)
{
  vtkMatrix4x4 *view =
      camera->GetCompositeProjectionTransformMatrix(1., -1., 1.);
  vtkBoundingBox seen; // [-1, 1] is the picture
  for (const vtkNew<vtkPolyData> &faces : all_faces)
    for (vtkIdType k = 0; k < faces->GetNumberOfPoints(); ++k)
    {
      double point[4];
      faces->GetPoint(k, point);
      point[3] = 1.;
      view->MultiplyPoint(point, point);
      seen.AddPoint(point[0] / point[3], point[1] / point[3], 0.);
    }
  constexpr double filled = 0.9, title = 0.04;
  const double zoom =
      2. * filled / std::max(seen.GetLength(0), seen.GetLength(1));
  double centre[3];
  seen.GetCenter(centre);
  camera->Zoom(zoom);
  camera->SetWindowCenter(zoom * centre[0], zoom * centre[1] + title);
}

/// One eye for every panel: three quarters from above.
vtkNew<vtkCamera> aim(const Faces &all_faces)
{
  const vtkBoundingBox box = bounds_of(all_faces);
  double centre[3];
  box.GetCenter(centre);
  const double distance = 2.2 * box.GetDiagonalLength();
  vtkNew<vtkCamera> camera;
  camera->SetFocalPoint(centre);
  camera->SetPosition(centre[0] + 0.49 * distance, centre[1] - 0.79 * distance,
                      centre[2] + 0.38 * distance);
  camera->SetViewUp(0., 0., 1.);
  camera->SetViewAngle(30.);
  fill(camera, all_faces);
  return camera;
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

Picture render_specimens(std::span<const SpecimenFiles> specimens,
                         double max_loss)
{
  vtkNew<EglWindow> window;
  if (!window->open())
    return {"", "this machine offers no EGL to draw with."};
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  const vtkNew<vtkLookupTable> colours = loss_colours(max_loss);
  Faces stones, all_faces;
  for (const SpecimenFiles &specimen : specimens)
  {
    stones.push_back(read_faces(specimen.surfaces));
    if (stones.back()->GetNumberOfCells() == 0)
      return {"", specimen.surfaces + " cannot be read or has no stones."};
    all_faces.emplace_back()->ShallowCopy(stones.back());
    if (!specimen.membrane.empty())
      all_faces.push_back(read_faces(specimen.membrane));
  }
  const vtkNew<vtkCamera> camera = aim(all_faces);
  const double size = bounds_of(all_faces).GetDiagonalLength();
  const int width = static_cast<int>(specimens.size()) * panel + bar_panel;
  PictureSheet sheet(width, panel);
  for (std::size_t k = 0; k < specimens.size(); ++k)
  {
    const vtkNew<vtkRenderer> renderer =
        specimen_renderer(specimens[k], stones[k], colours);
    renderer->SetActiveCamera(camera);
    renderer->ResetCameraClippingRange();
    add_depth(renderer, size);
    sheet.add(window, renderer, panel);
  }
  const vtkNew<vtkRenderer> bar = white_renderer();
  add_bar(bar, colours);
  sheet.add(window, bar, bar_panel);
  return {sheet.png(), "", width};
}
} // namespace spall
