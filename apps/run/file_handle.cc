#include "run/file_handle.h"

#include <cerrno>
#include <fcntl.h>
#include <unistd.h>

namespace spall
{
void FileHandle::note_error()
{
  if (first_error == 0)
    first_error = errno != 0 ? errno : EIO;
}

void FileHandle::open(const std::filesystem::path &path, int flags)
{
  close();
  first_error = 0;
  descriptor = ::open(path.c_str(), flags | O_CLOEXEC, 0666);
  if (descriptor < 0)
    note_error();
}

void FileHandle::open_empty(const std::filesystem::path &path)
{
  open(path, O_WRONLY | O_CREAT | O_TRUNC);
}

void FileHandle::open_at_end(const std::filesystem::path &path)
{
  open(path, O_WRONLY | O_CREAT | O_APPEND);
}

void FileHandle::open_folder(const std::filesystem::path &path)
{
  open(path, O_RDONLY | O_DIRECTORY);
}

void FileHandle::write(std::string_view bytes)
{
  while (!bytes.empty() && first_error == 0)
  {
    errno = 0;
    const ssize_t n = ::write(descriptor, bytes.data(), bytes.size());
    if (n > 0)
      bytes.remove_prefix(static_cast<std::size_t>(n));
    else if (errno != EINTR)
      note_error();
  }
}

void FileHandle::synchronise()
{
  if (first_error == 0 && ::fsync(descriptor) != 0 && errno != EINVAL &&
      errno != ENOTSUP)
    note_error();
}

void FileHandle::close()
{
  if (descriptor >= 0 && ::close(descriptor) != 0 && errno != EINTR)
    note_error();
  descriptor = -1;
}

void FileHandle::truncate(std::uint64_t size)
{
  if (::ftruncate(descriptor, static_cast<off_t>(size)) != 0)
    note_error();
}
} // namespace spall
