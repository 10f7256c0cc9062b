#include "rendering/egl_window.h"

#include <vtkObjectFactory.h>
#include <vtk_glew.h>

#include <EGL/eglext.h>

namespace spall
{
vtkStandardNewMacro(EglWindow);

EglWindow::~EglWindow()
{
  Finalize();
  if (context != EGL_NO_CONTEXT)
  {
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display, context);
  }
}

bool EglWindow::open()
{
  const auto get_display = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
      eglGetProcAddress("eglGetPlatformDisplayEXT"));
  if (!get_display)
    return false;
  display =
      get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr) ||
      !eglBindAPI(EGL_OPENGL_API))
    return false;
  const EGLint wanted[] = {EGL_SURFACE_TYPE,
                           EGL_PBUFFER_BIT,
                           EGL_RENDERABLE_TYPE,
                           EGL_OPENGL_BIT,
                           EGL_RED_SIZE,
                           8,
                           EGL_GREEN_SIZE,
                           8,
                           EGL_BLUE_SIZE,
                           8,
                           EGL_ALPHA_SIZE,
                           8,
                           EGL_DEPTH_SIZE,
                           24,
                           EGL_NONE};
  EGLConfig config = nullptr;
  EGLint n_configs = 0;
  if (!eglChooseConfig(display, wanted, &config, 1, &n_configs) ||
      n_configs == 0)
    return false;
  const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION,
                            3,
                            EGL_CONTEXT_MINOR_VERSION,
                            2,
                            EGL_CONTEXT_OPENGL_PROFILE_MASK,
                            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                            EGL_NONE};
  context = eglCreateContext(display, config, EGL_NO_CONTEXT, version);
  if (context == EGL_NO_CONTEXT ||
      !eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context))
    return false;
  SetReadyForRendering(true);
  SetIsCurrent(true);
  SetSupportsOpenGL(1);
  return true;
}

void EglWindow::MakeCurrent()
{
  eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context);
}

bool EglWindow::IsCurrent()
{
  return context != EGL_NO_CONTEXT && eglGetCurrentContext() == context;
}

void EglWindow::OpenGLInitContext()
{
  if (Initialized)
    return;
  // GLEW reports 4, no GLX display, although it has loaded every function.
  constexpr GLenum no_glx_display = 4;
  glewExperimental = GL_TRUE;
  const GLenum status = glewInit();
  if (status != GLEW_OK && status != no_glx_display)
    return;
  GlewInitValid = true;
  MaximumHardwareLineWidth = 1;
  Initialized = true;
}
} // namespace spall
