#include "run/whole_file.h"

#include "errors.h"

#include <fstream>
#include <system_error>

namespace spall
{
namespace
{
namespace fs = std::filesystem;

/// A pipe or a device is written as it is; of a link the file behind it.
bool is_written(const fs::path &path,
                const std::function<void(std::ostream &)> &write)
{
  std::error_code status;
  const bool is_there = fs::exists(path, status);
  const bool is_stream = is_there && !fs::is_regular_file(path, status);
  const fs::path target = is_there ? fs::canonical(path, status) : path,
                 draft = is_stream ? path : fs::path(target.string() + ".part");
  std::ofstream out(draft, std::ios::binary);
  write(out);
  out.close();
  if (is_stream)
    return static_cast<bool>(out);
  if (out)
    fs::rename(draft, target, status);
  if (out && !status)
    return true;
  fs::remove(draft, status);
  return false;
}
} // namespace

void write_whole(const fs::path &path,
                 const std::function<void(std::ostream &)> &write)
{
  if (!is_written(path, write))
    throw RunFailure(path.string() + ": cannot be written (disk full?)");
}

void write_text(const fs::path &path, const std::string &text)
{
  write_whole(path, [&text](std::ostream &out) { out << text; });
}

void write_asked(const fs::path &path, const std::string &text)
{
  if (!is_written(path, [&text](std::ostream &out) { out << text; }))
    throw InputError(path.string() + ": cannot be written");
}
} // namespace spall
