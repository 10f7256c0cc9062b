// A checkpoint of the default case. The state after the files of the run is one
// column of numbers and one of a text.
#include "test/checkpoint.h"

#include "case/case.h"
#include "run/binary_text.h"
#include "state_file.h"

#include <dem/binary.h>

#include <iterator>

namespace
{
std::string sound_file(const spall::Case &of)
{
  spall::Progressed done;
  done.frames = {{0.5, 0, "frames/particles_00000.vtu"}};
  done.spent = {{"contacts", 1.}};
  const std::filesystem::path path = fuzz::scratch().path() / "sound.bin";
  spall::write_checkpoint(
      *dem::one_rank(), path, of,
      [](std::ostream &out)
      {
        dem::write_column(out, std::vector<double>(10, 1.));
        spall::write_text(out, "state");
      },
      done);
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}
} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
  static const spall::Case of = spall::default_case("dynamic_triaxial");
  static const std::string sound = sound_file(of);
  const std::string path =
      fuzz::scratch().write("state.bin", fuzz::changed(sound, data, size));
  fuzz::try_to(
      [&]
      {
        spall::Progressed done;
        spall::read_checkpoint(
            *dem::one_rank(), path, of,
            [](std::istream &in)
            {
              std::vector<double> column;
              dem::read_column(in, column);
              spall::read_text(in);
            },
            done);
      });
  return 0;
}
