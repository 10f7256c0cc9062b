#include "run/frame_tables.h"

#include "run/whole_file.h"

#include <cstdio>
#include <system_error>

namespace spall
{
namespace
{
std::filesystem::path path_of(const std::filesystem::path &folder,
                              std::int64_t number)
{
  char name[64];
  std::snprintf(name, sizeof name, "tables_%05d.h5", static_cast<int>(number));
  return folder / "frames" / name;
}
} // namespace

void write_frame_tables(const std::filesystem::path &folder,
                        const dem::Engine &engine,
                        const dem::FrameDescription &frame)
{
  const dem::TableFile tables = dem::frame_tables(engine, frame);
  write_whole(path_of(folder, frame.number),
              [&](std::ostream &out) { dem::write_hdf5(out, tables); });
}

void remove_frame_tables(const std::filesystem::path &folder,
                         std::int64_t number)
{
  std::error_code status;
  std::filesystem::remove(path_of(folder, number), status);
}
} // namespace spall
