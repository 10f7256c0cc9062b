#include "output_file.h"

#include <cerrno>
#include <fstream>
#include <stdexcept>
#include <system_error>

namespace fem
{
void write_output(const std::string &path, std::string_view bytes)
{
  errno = 0;
  std::ofstream file(path, std::ios::binary);
  file << bytes;
  file.close();
  if (!file)
    throw std::runtime_error(path + ": cannot be written: " +
                             std::generic_category().message(errno));
}
} // namespace fem
