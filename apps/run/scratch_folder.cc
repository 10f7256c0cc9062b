#include "run/scratch_folder.h"

#include "errors.h"

#include <cstdlib> // mkdtemp, of POSIX
#include <string>
#include <system_error>

namespace spall
{
ScratchFolder::ScratchFolder()
{
  std::error_code status;
  std::string name =
      std::filesystem::temp_directory_path(status) / "spall.XXXXXX";
  if (status || !mkdtemp(name.data()))
    throw InputError("TMPDIR: must be a folder to write into");
  location = name;
}

ScratchFolder::~ScratchFolder()
{
  std::error_code status; // what stays behind is only temporary
  std::filesystem::remove_all(location, status);
}
} // namespace spall
