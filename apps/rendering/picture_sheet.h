#pragma once

#include "rendering/egl_window.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkRenderer.h>

#include <string>

namespace spall
{
/// One row of panels, each drawn finer than shown and averaged: the passes of
/// VTK neither share a window nor smooth the edges of translucent faces.
class PictureSheet
{
public:
  /// Lengths in the drawing over lengths in the picture [-].
  static constexpr int fineness = 2;

  PictureSheet(int width, int height); ///< [px]

  /// Draws the next panel from the left, this wide [px].
  void add(EglWindow *window, vtkRenderer *renderer, int width);

  std::string png() const; ///< the file as bytes

private:
  void copy(vtkImageData *fine, int width);

  vtkNew<vtkImageData> image;
  int height = 0; ///< [px]
  int next = 0;   ///< first free column [px]
};
} // namespace spall
