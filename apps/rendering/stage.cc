#include "rendering/stage.h"

#include <vtkActor.h>
#include <vtkBoundingBox.h>
#include <vtkColorTransferFunction.h>
#include <vtkLight.h>
#include <vtkMatrix4x4.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkScalarBarActor.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include <algorithm>

namespace spall
{
namespace
{
constexpr int fineness = PictureSheet::fineness;

vtkBoundingBox bounds_of(const Shapes &all_faces)
{
  vtkBoundingBox box;
  for (const vtkNew<vtkPolyData> &faces : all_faces)
    box.AddBounds(faces->GetBounds());
  return box;
}

/// Zooms and shifts until the points fill the picture.
void fill(vtkCamera *camera, const Shapes &all_faces)
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

} // namespace

vtkNew<vtkLookupTable> colour_table(const std::vector<RampPoint> &points,
                                    double low, double high)
{
  vtkNew<vtkColorTransferFunction> ramp;
  ramp->SetColorSpaceToLab();
  for (const RampPoint &point : points)
    ramp->AddRGBPoint(point.at, point.red, point.green, point.blue);
  vtkNew<vtkLookupTable> table;
  constexpr int n = 256;
  table->SetNumberOfTableValues(n);
  for (int k = 0; k < n; ++k)
  {
    double rgb[3];
    ramp->GetColor(k / (n - 1.), rgb);
    table->SetTableValue(k, rgb[0], rgb[1], rgb[2]);
  }
  table->SetRange(low, high);
  return table;
}

double diagonal_of(const Shapes &all_faces)
{
  return bounds_of(all_faces).GetDiagonalLength();
}

vtkNew<vtkCamera> aim(const Shapes &all_faces)
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

vtkNew<vtkRenderer> white_renderer()
{
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1., 1., 1.);
  return renderer;
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

void add_sheet(vtkRenderer *renderer, vtkPolyData *faces)
{
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

void add_coloured_faces(vtkRenderer *renderer, vtkPolyData *faces,
                        vtkLookupTable *colours)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(faces);
  mapper->SetScalarModeToUsePointData();
  mapper->SetLookupTable(colours);
  mapper->UseLookupTableScalarRangeOn();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->EdgeVisibilityOn();
  actor->GetProperty()->SetEdgeColor(0.35, 0.35, 0.35);
  actor->GetProperty()->SetLineWidth(fineness);
  // The colours are to be read: little shade.
  actor->GetProperty()->SetAmbient(0.75);
  actor->GetProperty()->SetDiffuse(0.3);
  renderer->AddActor(actor);
}

void add_bar(vtkRenderer *renderer, vtkLookupTable *colours,
             const std::string &title)
{
  vtkNew<vtkScalarBarActor> bar;
  bar->SetLookupTable(colours);
  bar->SetTitle(title.c_str());
  bar->SetNumberOfLabels(6);
  bar->SetLabelFormat("%.3g");
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

void add_panel(PictureSheet &sheet, EglWindow *window, vtkRenderer *renderer,
               vtkCamera *camera)
{
  renderer->SetActiveCamera(camera);
  renderer->ResetCameraClippingRange();
  sheet.add(window, renderer, panel_width);
}

void add_bar_panel(PictureSheet &sheet, EglWindow *window,
                   vtkLookupTable *colours, const std::string &title)
{
  const vtkNew<vtkRenderer> bar = white_renderer();
  add_bar(bar, colours, title);
  sheet.add(window, bar, bar_width);
}
} // namespace spall
