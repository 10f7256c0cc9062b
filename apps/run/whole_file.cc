#include "run/whole_file.h"

#include "errors.h"
#include "run/file_handle.h"

#include <array>
#include <cerrno>
#include <streambuf>
#include <system_error>
#include <unistd.h>

namespace spall
{
namespace
{
namespace fs = std::filesystem;

/// Collects what a stream puts out into large writes.
class FileBuffer : public std::streambuf
{
public:
  explicit FileBuffer(FileHandle &target) : file(target)
  {
    setp(bytes.data(), bytes.data() + bytes.size());
  }

protected:
  int sync() override
  {
    file.write({pbase(), static_cast<std::size_t>(pptr() - pbase())});
    setp(bytes.data(), bytes.data() + bytes.size());
    return file.error() == 0 ? 0 : -1;
  }
  int_type overflow(int_type c) override
  {
    if (sync() != 0)
      return traits_type::eof();
    return traits_type::eq_int_type(c, traits_type::eof())
               ? traits_type::not_eof(c)
               : sputc(traits_type::to_char_type(c));
  }
  std::streamsize xsputn(const char *text, std::streamsize n) override
  {
    if (n <= epptr() - pptr())
      return std::streambuf::xsputn(text, n);
    if (sync() == 0)
      file.write({text, static_cast<std::size_t>(n)});
    return file.error() == 0 ? n : 0;
  }

private:
  FileHandle &file;
  std::array<char, 1 << 15> bytes;
};

/// Of a link the file behind it.
fs::path target_of(const fs::path &path)
{
  std::error_code status;
  const fs::path target = fs::canonical(path, status);
  return status ? path : target;
}

bool is_stream(const fs::path &path)
{
  std::error_code status;
  return fs::exists(path, status) && !fs::is_regular_file(path, status);
}

std::string draft_ending(Writers writers)
{
  const std::string ending = ".part";
  return writers == Writers::one ? ending
                                 : "." + std::to_string(::getpid()) + ending;
}

/// Synchronises the names in a folder; errno.
int synchronise(const fs::path &folder)
{
  FileHandle names;
  names.open_folder(folder.empty() ? "." : folder);
  names.synchronise();
  return names.error();
}
} // namespace

class WholeFile::Draft
{
public:
  Draft(fs::path of, Durability its_durability, Writers writers)
      : path(std::move(of)), durability(its_durability),
        writes_directly(is_stream(path)), target(target_of(path)),
        draft(writes_directly
                  ? path
                  : fs::path(target.string() + draft_ending(writers)))
  {
    file.open_empty(draft);
    fault = file.error();
    is_open = fault == 0;
  }
  ~Draft()
  {
    std::error_code status;
    if (is_open && !writes_directly && !is_named)
      fs::remove(draft, status);
  }
  Draft(const Draft &) = delete;
  Draft &operator=(const Draft &) = delete;

  void finish()
  {
    out.flush();
    if (durability == Durability::on_disk)
      file.synchronise();
    file.close();
    fault = file.error() == 0 && !out ? EIO : file.error();
    if (fault == 0 && !writes_directly)
      take_name();
  }

  const fs::path path;
  int fault = 0; ///< errno
  bool is_open = false;

private:
  void take_name()
  {
    std::error_code status;
    fs::rename(draft, target, status);
    fault = status.value();
    is_named = fault == 0;
    if (is_named && durability == Durability::on_disk)
      fault = synchronise(target.parent_path());
  }

  const Durability durability;
  const bool writes_directly;
  const fs::path target, draft;
  bool is_named = false; ///< the draft has become the file
  FileHandle file;
  FileBuffer buffer{file};

public:
  std::ostream out{&buffer};
};

WholeFile::WholeFile(fs::path path, Durability durability, Writers writers)
    : draft(std::make_unique<Draft>(std::move(path), durability, writers))
{
}

WholeFile::~WholeFile() = default;

std::ostream &WholeFile::out()
{
  return draft->out;
}

void WholeFile::finish()
{
  draft->finish();
}

bool WholeFile::is_opened() const
{
  return draft->is_open;
}

int WholeFile::error() const
{
  return draft->fault;
}

void WholeFile::require_sound() const
{
  if (error() != 0)
    throw RunFailure(write_failure(draft->path, error()));
}

std::string write_failure(const fs::path &path, int error)
{
  return path.string() +
         ": cannot be written: " + std::generic_category().message(error);
}

void write_whole(const fs::path &path,
                 const std::function<void(std::ostream &)> &write,
                 Durability durability)
{
  WholeFile file(path, durability, Writers::one);
  file.require_sound();
  write(file.out());
  file.finish();
  file.require_sound();
}

void write_text(const fs::path &path, const std::string &text,
                Durability durability)
{
  write_whole(
      path, [&text](std::ostream &out) { out << text; }, durability);
}

void write_asked(const fs::path &path, const std::string &text)
{
  WholeFile file(path, Durability::usual, Writers::one);
  if (!file.is_opened())
    throw InputError(write_failure(path, file.error()));
  file.out() << text;
  file.finish();
  file.require_sound();
}
} // namespace spall
