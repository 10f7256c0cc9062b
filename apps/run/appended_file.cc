#include "run/appended_file.h"

#include "errors.h"
#include "run/whole_file.h"

namespace spall
{
namespace
{
/// Lines that are written at once [bytes].
constexpr std::size_t many = 1 << 13;
} // namespace

AppendedFile::~AppendedFile()
{
  file.write(pending);
  if (file.error() != 0 && !pending.empty())
    file.truncate(n_bytes); // no half of a line
}

void AppendedFile::require_written()
{
  if (file.error() == 0)
    return;
  pending.clear();
  throw RunFailure(write_failure(name, file.error()));
}

void AppendedFile::open_empty(const std::filesystem::path &path)
{
  name = path;
  pending.clear();
  n_bytes = 0;
  file.open_empty(path);
  require_written();
}

void AppendedFile::open_at_end(const std::filesystem::path &path)
{
  name = path;
  pending.clear();
  std::error_code status;
  const std::uintmax_t found = std::filesystem::file_size(path, status);
  n_bytes = status ? 0 : found;
  file.open_at_end(path);
  require_written();
}

void AppendedFile::add(std::string_view lines)
{
  pending += lines;
  if (pending.size() > many)
    flush();
}

void AppendedFile::flush()
{
  file.write(pending);
  if (file.error() != 0)
    file.truncate(n_bytes); // no half of a line
  require_written();
  n_bytes += pending.size();
  pending.clear();
}

void AppendedFile::synchronise()
{
  flush();
  file.synchronise();
  require_written();
}
} // namespace spall
