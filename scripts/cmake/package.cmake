# cpack -G DEB: spall (program, data, docs), libspall-dev (libraries, headers)
# and python3-spall (Python package, module of the particle engine).
set(CPACK_PACKAGE_NAME spall)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "Spall maintainers <maintainers@spall.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY
  "coupled FEM-DEM simulation of breakable graded aggregate")
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE
  GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
# Older than the first package of Debian itself would be.
set(CPACK_DEBIAN_PACKAGE_RELEASE 0spall1)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(spall_this_version
  "spall (= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME spall)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS
  "libgl1-mesa-dri, openmpi-bin, python3-spall")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "libspall-dev, paraview")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
  "Spall simulates tests of graded aggregate whose particles lose corners and
edges, inside deformable boundaries: dynamic triaxial tests, vibratory
compaction, the Los Angeles drum, single particles and subgrades.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libspall-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF) # it has none to look at
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${spall_this_version},\
 libdeal.ii-dev, libeigen3-dev, libopenmpi-dev, libvtk9-dev,\
 nlohmann-json3-dev, trilinos-all-dev, zlib1g-dev")
if(SPALL_RENDERING)
  string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    ", libegl-dev, libopengl-dev")
endif()
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
  "Static libraries, headers and the CMake package of Spall, for programs that
add contact laws, boundaries or kinds of tests.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-spall)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
  "${spall_this_version}, python3, python3-numpy")
if(TARGET spall_engine)
  # Its module is for this Python alone.
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
  math(EXPR next "${Python3_VERSION_MINOR} + 1")
  string(APPEND CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    ", python3 (>= 3.${Python3_VERSION_MINOR}), python3 (<< 3.${next})")
endif()
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-h5py")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
  ${PROJECT_SOURCE_DIR}/scripts/debian/postinst
  ${PROJECT_SOURCE_DIR}/scripts/debian/prerm)
set(CPACK_COMPONENT_PYTHON_DESCRIPTION
  "Cases, runs, studies and calibration of Spall from Python, and its particle
engine as a module whose columns are numpy arrays.")

# Files that Debian asks for or keeps elsewhere than cmake --install does.
set(CPACK_SPALL_SOURCE ${PROJECT_SOURCE_DIR})
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/debian_files.cmake)
include(CPack)
foreach(component program development python)
  if(NOT component STREQUAL python OR SPALL_PYTHON)
    cpack_add_component(${component} GROUP ${component})
  endif()
endforeach()
