# Installation: libraries and headers as components of the CMake package Spall
# (find_package(Spall COMPONENTS dem fem coupling program)), and the program with
# its data, which it finds relative to itself.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(SPALL_INSTALL_DATA ${CMAKE_INSTALL_DATADIR}/spall/data)
set(SPALL_INSTALL_CMAKE ${CMAKE_INSTALL_LIBDIR}/cmake/Spall)
set(SPALL_INSTALL_HEADERS ${CMAKE_INSTALL_INCLUDEDIR}/spall)

# spall_install_library(COMPONENT): the target spall_COMPONENT as Spall::COMPONENT.
function(spall_install_library name)
  set_target_properties(spall_${name} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(spall_${name} PUBLIC cxx_std_20)
  install(TARGETS spall_${name} EXPORT spall_${name}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
  install(EXPORT spall_${name} NAMESPACE Spall:: FILE Spall_${name}.cmake
    DESTINATION ${SPALL_INSTALL_CMAKE} COMPONENT development)
endfunction()

# spall_install_headers(FOLDER DESTINATION): those below FOLDER.
function(spall_install_headers folder destination)
  install(DIRECTORY ${folder}/ DESTINATION ${SPALL_INSTALL_HEADERS}/${destination}
    COMPONENT development FILES_MATCHING PATTERN "*.h")
endfunction()

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/SpallConfig.cmake.in
  ${PROJECT_BINARY_DIR}/SpallConfig.cmake
  INSTALL_DESTINATION ${SPALL_INSTALL_CMAKE}
  PATH_VARS SPALL_INSTALL_HEADERS)
write_basic_package_version_file(
  ${PROJECT_BINARY_DIR}/SpallConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES
  ${PROJECT_BINARY_DIR}/SpallConfig.cmake
  ${PROJECT_BINARY_DIR}/SpallConfigVersion.cmake
  ${CMAKE_CURRENT_LIST_DIR}/loops.cmake
  ${CMAKE_CURRENT_LIST_DIR}/dependencies_dem.cmake
  ${CMAKE_CURRENT_LIST_DIR}/dependencies_dem_io.cmake
  ${CMAKE_CURRENT_LIST_DIR}/dependencies_dem_mpi.cmake
  ${CMAKE_CURRENT_LIST_DIR}/dependencies_fem.cmake
  ${CMAKE_CURRENT_LIST_DIR}/dependencies_app.cmake
  ${CMAKE_CURRENT_LIST_DIR}/dependencies_rendering.cmake
  DESTINATION ${SPALL_INSTALL_CMAKE} COMPONENT development)

install(DIRECTORY ${PROJECT_SOURCE_DIR}/data/
  DESTINATION ${SPALL_INSTALL_DATA} COMPONENT program)
# Without what scripts/docs.sh alone needs.
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs/
  DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program
  PATTERN conf.py EXCLUDE PATTERN Doxyfile EXCLUDE PATTERN _static EXCLUDE
  PATTERN __pycache__ EXCLUDE)
install(FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/LICENSE
  ${PROJECT_SOURCE_DIR}/NOTICE
  DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(FILES ${PROJECT_SOURCE_DIR}/scripts/completion/spall.bash
  DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
  RENAME spall COMPONENT program)
install(FILES ${PROJECT_SOURCE_DIR}/scripts/completion/_spall
  DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions COMPONENT program)
install(FILES ${PROJECT_SOURCE_DIR}/scripts/completion/spall.1
  DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
