// A packing (CSV, plain or compressed).
#include "fuzz.h"
#include "specimen/packing_file.h"

int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
  const std::string path =
      fuzz::scratch().write("packing.csv", fuzz::bytes_of(data, size));
  fuzz::try_to([&] { spall::read_packing(path); });
  return 0;
}
