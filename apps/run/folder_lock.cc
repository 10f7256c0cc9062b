#include "run/folder_lock.h"

#include "errors.h"

#include <cerrno>
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace spall
{
FolderLock::FolderLock(const std::filesystem::path &folder)
    : file(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC))
{
  if (file < 0 || ::flock(file, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK)
    return;
  ::close(file);
  throw InputError("--out " + folder.string() +
                   ": another run writes there: wait for its end, or choose "
                   "another folder");
}

FolderLock::~FolderLock()
{
  if (file >= 0)
    ::close(file);
}
} // namespace spall
