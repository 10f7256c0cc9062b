// A shape file (JSON).
#include "fuzz.h"
#include "shape/file.h"

int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
  const std::string path =
      fuzz::scratch().write("shape.json", fuzz::bytes_of(data, size));
  fuzz::try_to([&] { spall::read_shape(path); });
  return 0;
}
