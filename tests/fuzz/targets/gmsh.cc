// A file of gmsh as a membrane and as a ground.
#include "fuzz.h"

#include <fem/solid_mesh.h>
#include <fem/surface_file.h>

int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
  const std::string path =
      fuzz::scratch().write("mesh.msh", fuzz::bytes_of(data, size));
  fuzz::try_to([&] { fem::read_surface_mesh(path); });
  fuzz::try_to([&] { fem::read_solid_mesh(path); });
  return 0;
}
