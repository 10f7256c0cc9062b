# What the particle engine needs to run on many ranks.
find_package(MPI REQUIRED COMPONENTS C CXX)
find_path(ZOLTAN_INCLUDE_DIR zoltan.h PATH_SUFFIXES trilinos REQUIRED)
find_library(ZOLTAN_LIBRARY NAMES trilinos_zoltan zoltan REQUIRED)
if(NOT TARGET dep_zoltan)
  add_library(dep_zoltan INTERFACE IMPORTED GLOBAL)
  target_include_directories(dep_zoltan SYSTEM INTERFACE ${ZOLTAN_INCLUDE_DIR})
  target_link_libraries(dep_zoltan INTERFACE ${ZOLTAN_LIBRARY} MPI::MPI_CXX)
endif()
