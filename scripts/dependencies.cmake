# The packages behind the include table of the architecture, one interface
# target each. deal.II comes before VTK so that the HDF5 header of Open MPI
# is found.
find_package(MPI REQUIRED COMPONENTS C CXX)
find_package(OpenMP REQUIRED COMPONENTS CXX)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(nlohmann_json REQUIRED)
find_package(ZLIB REQUIRED)

find_package(deal.II 9.4 REQUIRED CONFIG)
include(${DEAL_II_TARGET_CONFIG})
add_library(dep_dealii INTERFACE)
target_include_directories(dep_dealii SYSTEM INTERFACE ${DEAL_II_INCLUDE_DIRS})
target_compile_definitions(dep_dealii INTERFACE
  ${DEAL_II_USER_DEFINITIONS} $<$<CONFIG:Debug>:DEBUG>)
target_link_libraries(dep_dealii INTERFACE
  $<IF:$<CONFIG:Debug>,deal.ii.g,deal.ii>)

find_path(CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse REQUIRED)
find_library(CHOLMOD_LIBRARY cholmod REQUIRED)
add_library(dep_cholmod INTERFACE)
target_include_directories(dep_cholmod SYSTEM INTERFACE ${CHOLMOD_INCLUDE_DIR})
target_link_libraries(dep_cholmod INTERFACE Eigen3::Eigen ${CHOLMOD_LIBRARY})

find_library(UMFPACK_LIBRARY umfpack REQUIRED)
add_library(dep_umfpack INTERFACE)
target_include_directories(dep_umfpack SYSTEM INTERFACE ${CHOLMOD_INCLUDE_DIR})
target_link_libraries(dep_umfpack INTERFACE Eigen3::Eigen ${UMFPACK_LIBRARY})

find_path(ZOLTAN_INCLUDE_DIR zoltan.h PATH_SUFFIXES trilinos REQUIRED)
find_library(ZOLTAN_LIBRARY NAMES trilinos_zoltan zoltan REQUIRED)
add_library(dep_zoltan INTERFACE)
target_include_directories(dep_zoltan SYSTEM INTERFACE ${ZOLTAN_INCLUDE_DIR})
target_link_libraries(dep_zoltan INTERFACE ${ZOLTAN_LIBRARY} MPI::MPI_CXX)

find_package(VTK 9.1 REQUIRED COMPONENTS
  CommonCore CommonDataModel CommonExecutionModel
  IOXML IOXMLParser IOImage IOExport
  FiltersCore FiltersSources
  RenderingCore RenderingOpenGL2 RenderingFreeType RenderingAnnotation
  RenderingContext2D RenderingContextOpenGL2 InteractionStyle
  ChartsCore ViewsCore ViewsContext2D glew)
find_package(OpenGL REQUIRED COMPONENTS EGL OpenGL)
