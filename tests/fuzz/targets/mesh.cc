// A mesh of the format FUZZ_FORMAT: the reader, then the checks and the weld of
// a fit.
#include "closed_mesh.h"
#include "fuzz.h"

#include <dem/io/mesh_reader.h>

int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
  fuzz::try_to(
      [&]
      {
        const dem::TriangleMesh mesh = dem::parse_mesh(
            fuzz::bytes_of(data, size), dem::MeshFormat::FUZZ_FORMAT);
        dem::detail::close_mesh(mesh);
      });
  return 0;
}
