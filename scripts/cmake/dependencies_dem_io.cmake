# What reading and writing files of the particle engine needs.
find_package(VTK 9.1 REQUIRED COMPONENTS
  CommonCore CommonDataModel CommonExecutionModel IOXML IOXMLParser)
set(SPALL_VTK_FILES ${VTK_LIBRARIES})
