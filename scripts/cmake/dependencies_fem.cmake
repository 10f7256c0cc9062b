# What the deformable boundaries need.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(deal.II 9.4 REQUIRED CONFIG)
include(${DEAL_II_TARGET_CONFIG})
find_path(CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse REQUIRED)
find_library(CHOLMOD_LIBRARY cholmod REQUIRED)
find_library(UMFPACK_LIBRARY umfpack REQUIRED)
if(NOT TARGET dep_dealii)
  add_library(dep_dealii INTERFACE IMPORTED GLOBAL)
  target_include_directories(dep_dealii SYSTEM INTERFACE
    ${DEAL_II_INCLUDE_DIRS})
  target_compile_definitions(dep_dealii INTERFACE
    ${DEAL_II_USER_DEFINITIONS} $<$<CONFIG:Debug>:DEBUG>)
  target_link_libraries(dep_dealii INTERFACE
    $<IF:$<CONFIG:Debug>,deal.ii.g,deal.ii>)
  foreach(package cholmod umfpack)
    string(TOUPPER ${package} upper)
    add_library(dep_${package} INTERFACE IMPORTED GLOBAL)
    target_include_directories(dep_${package} SYSTEM INTERFACE
      ${CHOLMOD_INCLUDE_DIR})
    target_link_libraries(dep_${package} INTERFACE
      Eigen3::Eigen ${${upper}_LIBRARY})
  endforeach()
endif()
