#include "rendering/render.h"

#include "rendering/egl_window.h"
#include "rendering/picture_sheet.h"
#include "rendering/stage.h"

#include <vtkActor.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFloatArray.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkRenderStepsPass.h>
#include <vtkSSAOPass.h>

namespace spall
{
namespace
{
/// From the grey of an unbroken particle over orange to dark red.
vtkNew<vtkLookupTable> loss_colours(double max_loss)
{
  return colour_table({{0., 0.86, 0.85, 0.82},
                       {0.3, 0.96, 0.76, 0.45},
                       {0.6, 0.87, 0.39, 0.20},
                       {1., 0.40, 0.02, 0.15}},
                      0., 100. * max_loss);
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

void add_particles(vtkRenderer *renderer, vtkPolyData *faces,
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
  vtkNew<vtkActor> particles;
  particles->SetMapper(mapper);
  particles->GetProperty()->SetAmbient(0.18);
  particles->GetProperty()->SetDiffuse(0.85);
  particles->GetProperty()->SetSpecular(0.06);
  particles->GetProperty()->SetSpecularPower(12.);
  renderer->AddActor(particles);
}

/// Darkens the gaps between particles, which gives the picture its depth.
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

vtkNew<vtkRenderer> specimen_renderer(const SpecimenFiles &specimen,
                                      vtkPolyData *faces,
                                      vtkLookupTable *colours)
{
  vtkNew<vtkRenderer> renderer = white_renderer();
  add_particles(renderer, faces, colours);
  if (!specimen.sheet.empty())
    add_sheet(renderer, read_faces(specimen.sheet));
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
  Shapes particles, all_faces;
  for (const SpecimenFiles &specimen : specimens)
  {
    particles.push_back(read_faces(specimen.surfaces));
    if (particles.back()->GetNumberOfCells() == 0)
      return {"", specimen.surfaces + " cannot be read or has no particles."};
    all_faces.emplace_back()->ShallowCopy(particles.back());
    if (!specimen.sheet.empty())
      all_faces.push_back(read_faces(specimen.sheet));
  }
  const vtkNew<vtkCamera> camera = aim(all_faces);
  const double size = diagonal_of(all_faces);
  const int width =
      static_cast<int>(specimens.size()) * panel_width + bar_width;
  PictureSheet sheet(width, panel_width);
  for (std::size_t k = 0; k < specimens.size(); ++k)
  {
    const vtkNew<vtkRenderer> renderer =
        specimen_renderer(specimens[k], particles[k], colours);
    renderer->SetActiveCamera(camera);
    renderer->ResetCameraClippingRange();
    add_depth(renderer, size);
    sheet.add(window, renderer, panel_width);
  }
  const vtkNew<vtkRenderer> bar = white_renderer();
  add_bar(bar, colours, "Loss of\nmass (%)\n");
  sheet.add(window, bar, bar_width);
  return {sheet.png(), "", width};
}
} // namespace spall
