// A library for LD_PRELOAD: makes one operation on the files below a folder
// fail, or ends the process there. Settings, from the environment:
//   FAULT_FOLDER  the folder (absolute)
//   FAULT_AT      which operation, from 1; 0 or none: none
//   FAULT_KIND    fail: that one, with EIO; full: from that one on all that
//   need
//                 room, with ENOSPC; kill: the process ends with SIGKILL
//   FAULT_LOG     a file that gets a line "number name path" for each operation
// A write that fails, or that the process ends in, has written half before.
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>
#include <string>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

namespace
{
std::atomic<long> count{0};

/// The next definition of a function, which is that of the system.
template <class Function>
Function *system_call(const char *name)
{
  return reinterpret_cast<Function *>(dlsym(RTLD_NEXT, name));
}

std::string setting(const char *name)
{
  const char *value = std::getenv(name);
  return value ? value : "";
}

bool is_candidate(const std::string &path)
{
  static const std::string folder = setting("FAULT_FOLDER");
  if (folder.empty() || path.empty())
    return false;
  const std::string absolute =
      path[0] == '/' ? path : std::string(get_current_dir_name()) + "/" + path;
  return absolute.starts_with(folder);
}

std::string path_of(int file)
{
  char path[4096];
  const std::string link = "/proc/self/fd/" + std::to_string(file);
  const ssize_t n = readlink(link.c_str(), path, sizeof path);
  return n > 0 ? std::string(path, static_cast<std::size_t>(n)) : "";
}

void note(long number, const char *name, const std::string &path)
{
  static const int log = static_cast<int>(
      syscall(SYS_openat, AT_FDCWD, setting("FAULT_LOG").c_str(),
              O_WRONLY | O_CREAT | O_APPEND, 0644));
  const std::string line =
      std::to_string(number) + " " + name + " " + path + "\n";
  if (log >= 0)
    syscall(SYS_write, log, line.data(), line.size());
}

enum class Verdict
{
  pass,
  fail,
  kill
};

[[noreturn]] void end_here()
{
  kill(getpid(), SIGKILL);
  for (;;)
    pause();
}

/// Counts an operation; errno is set where it is to fail.
Verdict judge(const char *name, const std::string &path, bool needs_room)
{
  static const long at = std::atol(setting("FAULT_AT").c_str());
  static const std::string kind = setting("FAULT_KIND");
  if (!is_candidate(path))
    return Verdict::pass;
  const long number = ++count;
  note(number, name, path);
  const bool is_here = number == at;
  if (kind == "kill" && is_here)
    return Verdict::kill;
  if (kind == "full" && at > 0 && number >= at && needs_room)
  {
    errno = ENOSPC;
    return Verdict::fail;
  }
  if (kind == "fail" && is_here)
  {
    errno = EIO;
    return Verdict::fail;
  }
  return Verdict::pass;
}

/// Whether an operation without half-way states is to fail.
bool fails(const char *name, const std::string &path, bool needs_room)
{
  const Verdict verdict = judge(name, path, needs_room);
  if (verdict == Verdict::kill)
    end_here();
  return verdict == Verdict::fail;
}

bool is_for_writing(int flags)
{
  return (flags & O_ACCMODE) != O_RDONLY;
}

int open_file(const char *name, const char *path, int flags, mode_t mode)
{
  if (is_for_writing(flags) && fails("open", path, (flags & O_CREAT) != 0))
    return -1;
  return system_call<int(const char *, int, ...)>(name)(path, flags, mode);
}

FILE *open_stream(const char *name, const char *path, const char *mode)
{
  if (mode[0] != 'r' && fails("open", path, true))
    return nullptr;
  return system_call<FILE *(const char *, const char *)>(name)(path, mode);
}

bool is_written(int file)
{
  const int flags = fcntl(file, F_GETFL);
  return flags >= 0 && is_for_writing(flags);
}

int cut(const char *name, int file, off_t size)
{
  if (fails("truncate", path_of(file), false))
    return -1;
  return system_call<int(int, off_t)>(name)(file, size);
}

int cut(const char *name, const char *path, off_t size)
{
  if (fails("truncate", path, false))
    return -1;
  return system_call<int(const char *, off_t)>(name)(path, size);
}
} // namespace

extern "C"
{
  int open(const char *path, int flags, ...)
  {
    va_list more;
    va_start(more, flags);
    const mode_t mode = va_arg(more, mode_t);
    va_end(more);
    return open_file("open", path, flags, mode);
  }

  int open64(const char *path, int flags, ...)
  {
    va_list more;
    va_start(more, flags);
    const mode_t mode = va_arg(more, mode_t);
    va_end(more);
    return open_file("open64", path, flags, mode);
  }

  FILE *fopen(const char *path, const char *mode)
  {
    return open_stream("fopen", path, mode);
  }

  FILE *fopen64(const char *path, const char *mode)
  {
    return open_stream("fopen64", path, mode);
  }

  ssize_t write(int file, const void *bytes, size_t n)
  {
    const auto put = system_call<ssize_t(int, const void *, size_t)>("write");
    const Verdict verdict = judge("write", path_of(file), true);
    if (verdict == Verdict::pass)
      return put(file, bytes, n);
    const int fault = errno;
    put(file, bytes, n / 2);
    if (verdict == Verdict::kill)
      end_here();
    errno = fault;
    return -1;
  }

  ssize_t writev(int file, const iovec *parts, int n)
  {
    const auto put = system_call<ssize_t(int, const iovec *, int)>("writev");
    const Verdict verdict = judge("write", path_of(file), true);
    if (verdict == Verdict::pass)
      return put(file, parts, n);
    const int fault = errno;
    put(file, parts, n / 2);
    if (verdict == Verdict::kill)
      end_here();
    errno = fault;
    return -1;
  }

  int fsync(int file)
  {
    if (fails("fsync", path_of(file), false))
      return -1;
    return system_call<int(int)>("fsync")(file);
  }

  int close(int file)
  {
    const bool is_failing =
        is_written(file) && fails("close", path_of(file), false);
    const int fault = errno;
    const int status = system_call<int(int)>("close")(file);
    if (!is_failing)
      return status;
    errno = fault;
    return -1;
  }

  int fclose(FILE *stream)
  {
    const int file = fileno(stream);
    const bool is_failing =
        is_written(file) && fails("close", path_of(file), false);
    const int fault = errno;
    const int status = system_call<int(FILE *)>("fclose")(stream);
    if (!is_failing)
      return status;
    errno = fault;
    return EOF;
  }

  int rename(const char *from, const char *to)
  {
    if (fails("rename", to, true))
      return -1;
    return system_call<int(const char *, const char *)>("rename")(from, to);
  }

  int mkdir(const char *path, mode_t mode)
  {
    if (fails("mkdir", path, true))
      return -1;
    return system_call<int(const char *, mode_t)>("mkdir")(path, mode);
  }

  int remove(const char *path)
  {
    if (fails("remove", path, false))
      return -1;
    return system_call<int(const char *)>("remove")(path);
  }

  int ftruncate(int file, off_t size)
  {
    return cut("ftruncate", file, size);
  }
  int ftruncate64(int file, off64_t size)
  {
    return cut("ftruncate64", file, size);
  }
  int truncate(const char *path, off_t size)
  {
    return cut("truncate", path, size);
  }
  int truncate64(const char *path, off64_t size)
  {
    return cut("truncate64", path, size);
  }
}
