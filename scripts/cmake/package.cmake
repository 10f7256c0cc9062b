# cpack -G DEB: spall (program, data, docs) and libspall-dev (libraries, headers).
set(CPACK_PACKAGE_NAME spall)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "Spall maintainers <maintainers@spall.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY
  "coupled FEM-DEM simulation of breakable graded aggregate")
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME spall)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "openmpi-bin, python3-numpy")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libspall-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "libeigen3-dev, libdeal.ii-dev, libvtk9-dev, trilinos-all-dev, libopenmpi-dev, nlohmann-json3-dev, zlib1g-dev, libegl-dev, libopengl-dev")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
  "Spall simulates tests of graded aggregate whose particles lose corners and
edges, inside deformable boundaries: dynamic triaxial tests, vibratory
compaction, the Los Angeles drum, single particles and subgrades.")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
  "Static libraries, headers and the CMake package of Spall, for programs that
add contact laws, boundaries or kinds of tests.")
include(CPack)
cpack_add_component(program GROUP program)
cpack_add_component(development GROUP development)
