# What the pictures of reports need (SPALL_RENDERING).
find_package(OpenGL REQUIRED COMPONENTS EGL OpenGL)
find_package(VTK 9.1 REQUIRED COMPONENTS
  CommonCore CommonDataModel CommonExecutionModel IOXML IOImage FiltersCore
  RenderingCore RenderingOpenGL2 RenderingFreeType RenderingAnnotation glew)
set(SPALL_VTK_RENDERING ${VTK_LIBRARIES})
