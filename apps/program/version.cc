#include "program/version.h"

#include <dem/io/table_file.h>

#include <deal.II/base/config.h>
#include <mpi.h>

#include <array>

namespace spall
{
namespace
{
std::string trilinos_version()
{
  return std::to_string(DEAL_II_TRILINOS_VERSION_MAJOR) + "." +
         std::to_string(DEAL_II_TRILINOS_VERSION_MINOR) + "." +
         std::to_string(DEAL_II_TRILINOS_VERSION_SUBMINOR);
}

/// Name and version of the MPI library; more may follow after a comma or in
/// further lines. May be called before MPI is initialised.
std::string mpi_version()
{
  std::array<char, MPI_MAX_LIBRARY_VERSION_STRING> text{};
  int length = 0;
  MPI_Get_library_version(text.data(), &length);
  const std::string all(text.data());
  return all.substr(0, all.find_first_of(",\n"));
}
} // namespace

std::string version_text()
{
  const std::string hdf5 = dem::hdf5_version();
  return "spall " SPALL_VERSION "\n"
         "commit " +
         std::string(source_commit) +
         "\n"
         "deal.II " DEAL_II_PACKAGE_VERSION "\n"
         "Trilinos " +
         trilinos_version() +
         "\n"
         "VTK " SPALL_VTK_VERSION "\n" +
         (hdf5.empty() ? "" : "HDF5 " + hdf5 + "\n") +
         "Eigen " SPALL_EIGEN_VERSION "\n"
         "MPI " +
         mpi_version() +
         "\n"
         "compiler " SPALL_COMPILER "\n"
         "build type " SPALL_BUILD_TYPE "\n";
}
} // namespace spall
