# What the program needs besides its libraries.
find_package(MPI REQUIRED COMPONENTS C CXX)
find_package(nlohmann_json REQUIRED)
find_package(ZLIB REQUIRED)
if(SPALL_RENDERING)
  include(${CMAKE_CURRENT_LIST_DIR}/dependencies_rendering.cmake)
endif()
