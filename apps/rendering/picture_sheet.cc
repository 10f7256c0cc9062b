#include "rendering/picture_sheet.h"

#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

namespace spall
{
namespace
{
unsigned char *pixel(vtkImageData *from, int x, int y)
{
  return static_cast<unsigned char *>(from->GetScalarPointer(x, y, 0));
}
} // namespace

PictureSheet::PictureSheet(int width, int height_in) : height(height_in)
{
  image->SetDimensions(width, height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
}

void PictureSheet::add(EglWindow *window, vtkRenderer *renderer, int width)
{
  window->SetSize(fineness * width, fineness * height);
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

std::string PictureSheet::png() const
{
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(image);
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray *bytes = writer->GetResult();
  return {reinterpret_cast<const char *>(bytes->GetPointer(0)),
          static_cast<std::size_t>(bytes->GetNumberOfValues())};
}

void PictureSheet::copy(vtkImageData *fine, int width)
{
  for (int y = 0; y < height; ++y)
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
} // namespace spall
