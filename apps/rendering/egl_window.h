#pragma once

#include <vtkGenericOpenGLRenderWindow.h>

#include <EGL/egl.h>

namespace spall
{
/// A window of VTK without a display: OpenGL on EGL without any surface.
/// Debian's own window calls abort() when there is no X server.
class EglWindow : public vtkGenericOpenGLRenderWindow
{
public:
  static EglWindow *New();
  // clang-format off
  vtkTypeMacro(EglWindow, vtkGenericOpenGLRenderWindow)
      // clang-format on

      /// False if this machine has no EGL with OpenGL 3.2; then do not render.
      bool open();

  void MakeCurrent() override;
  bool IsCurrent() override;
  void OpenGLInitContext() override;

protected:
  EglWindow() = default;
  ~EglWindow() override;

private:
  EGLDisplay display = EGL_NO_DISPLAY; ///< one per process, never terminated
  EGLContext context = EGL_NO_CONTEXT;
};
} // namespace spall
