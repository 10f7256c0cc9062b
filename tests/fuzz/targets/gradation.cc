// A gradation (CSV).
#include "specimen/gradation.h"

#include "fuzz.h"

int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
  const std::string path =
      fuzz::scratch().write("gradation.csv", fuzz::bytes_of(data, size));
  fuzz::try_to([&] { spall::read_gradation(path); });
  return 0;
}
