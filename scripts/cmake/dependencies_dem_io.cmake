# What reading and writing files of the particle engine needs.
find_package(VTK 9.1 REQUIRED COMPONENTS
  CommonCore CommonDataModel CommonExecutionModel IOXML IOXMLParser)
set(SPALL_VTK_FILES ${VTK_LIBRARIES})
# Tables of frames: HDF5 of the MPI that deal.II has, whose header includes mpi.h.
if(SPALL_HDF5)
  find_package(MPI REQUIRED COMPONENTS C CXX)
  find_path(HDF5_OPENMPI_INCLUDE_DIR hdf5.h PATH_SUFFIXES hdf5/openmpi REQUIRED)
  find_library(HDF5_OPENMPI_LIBRARY NAMES hdf5_openmpi hdf5 REQUIRED)
  if(NOT TARGET dep_hdf5)
    add_library(dep_hdf5 INTERFACE IMPORTED GLOBAL)
    target_include_directories(dep_hdf5 SYSTEM INTERFACE
      ${HDF5_OPENMPI_INCLUDE_DIR})
    target_link_libraries(dep_hdf5 INTERFACE
      ${HDF5_OPENMPI_LIBRARY} MPI::MPI_CXX)
  endif()
endif()
