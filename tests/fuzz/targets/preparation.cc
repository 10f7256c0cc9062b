// A preparation that is kept. Its state is a column of numbers and a text.
#include "run/binary_text.h"
#include "state_file.h"
#include "test/preparation_store.h"

#include <dem/binary.h>

#include <iterator>

namespace
{
std::string sound_file(const spall::PreparationStore &store)
{
  store.store(*dem::one_rank(),
              [](std::ostream &out)
              {
                dem::write_column(out, std::vector<double>(10, 1.));
                spall::write_text(out, "state");
              });
  std::ifstream in(store.path(), std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}
} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
  static const spall::PreparationStore store(fuzz::scratch().path(),
                                             "spheres in a box");
  static const std::string sound = sound_file(store);
  fuzz::scratch().write(store.path().filename().string(),
                        fuzz::changed(sound, data, size));
  std::string said;
  const auto restore = [](std::istream &in)
  {
    std::vector<double> column;
    dem::read_column(in, column);
    spall::read_text(in);
  };
  if (!store.take(*dem::one_rank(), restore, said))
    fuzz::check_message(said);
  return 0;
}
