#pragma once

#include "rendering/picture_sheet.h"

#include <vtkCamera.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>

#include <string>
#include <vector>

/// What the panels of the pictures have in common.
namespace spall
{
inline constexpr int panel_width = 900, bar_width = 220; ///< [px]

using Shapes = std::vector<vtkNew<vtkPolyData>>;

/// A colour at a share of the range, all from 0 to 1.
struct RampPoint
{
  double at, red, green, blue;
};

/// Colours between two values.
vtkNew<vtkLookupTable> colour_table(const std::vector<RampPoint> &points,
                                    double low, double high);

/// Of the box round all shapes [m].
double diagonal_of(const Shapes &shapes);

/// One eye for every panel that fills it: three quarters from above.
vtkNew<vtkCamera> aim(const Shapes &shapes);

vtkNew<vtkRenderer> white_renderer();
void add_title(vtkRenderer *renderer, const std::string &title);
/// One light from the upper left, a weak one from the right.
void add_lights(vtkRenderer *renderer);
/// A membrane or plate, half transparent, with its mesh.
void add_sheet(vtkRenderer *renderer, vtkPolyData *faces);
/// Faces with their mesh, coloured by the scalars of their points.
void add_coloured_faces(vtkRenderer *renderer, vtkPolyData *faces,
                        vtkLookupTable *colours);
void add_bar(vtkRenderer *renderer, vtkLookupTable *colours,
             const std::string &title);

/// The next panel of a sheet, and one for the colours.
void add_panel(PictureSheet &sheet, EglWindow *window, vtkRenderer *renderer,
               vtkCamera *camera);
void add_bar_panel(PictureSheet &sheet, EglWindow *window,
                   vtkLookupTable *colours, const std::string &title);
} // namespace spall
