// A case file with the ending FUZZ_ENDING, of any kind.
#include "case/file.h"
#include "fuzz.h"

int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
  const std::string path =
      fuzz::scratch().write("case" FUZZ_ENDING, fuzz::bytes_of(data, size));
  fuzz::try_to([&] { spall::read_case(path, {}); });
  return 0;
}
