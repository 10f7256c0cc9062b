# What reading and writing files of the particle engine needs, and the report of
# the program.
find_package(VTK 9.1 REQUIRED COMPONENTS
  CommonCore CommonDataModel CommonExecutionModel
  IOXML IOXMLParser IOImage IOExport
  FiltersCore FiltersSources
  RenderingCore RenderingOpenGL2 RenderingFreeType RenderingAnnotation
  RenderingContext2D RenderingContextOpenGL2 InteractionStyle
  ChartsCore ViewsCore ViewsContext2D glew)
