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

/// Takes a draft away that has not become the file.
class Draft
{
public:
  explicit Draft(fs::path draft) : path(std::move(draft)) {}
  ~Draft()
  {
    std::error_code status;
    if (!is_kept)
      fs::remove(path, status);
  }
  Draft(const Draft &) = delete;
  Draft &operator=(const Draft &) = delete;

  const fs::path path;
  bool is_kept = false;
};

struct Outcome
{
  int error = 0; ///< errno, 0: written
  bool is_opened = false;
};

/// Of a link the file behind it.
fs::path target_of(const fs::path &path)
{
  std::error_code status;
  const fs::path target = fs::canonical(path, status);
  return status ? path : target;
}

/// The file that is open has been given to the stream.
int finish(FileHandle &file, std::ostream &out, Durability durability)
{
  out.flush();
  if (durability == Durability::on_disk)
    file.synchronise();
  file.close();
  return file.error() == 0 && !out ? EIO : file.error();
}

/// Moves a complete draft to its name; errno.
int take_name(Draft &draft, const fs::path &target, Durability durability)
{
  std::error_code status;
  fs::rename(draft.path, target, status);
  if (status)
    return status.value();
  draft.is_kept = true;
  if (durability == Durability::usual)
    return 0;
  const fs::path folder = target.parent_path();
  FileHandle names;
  names.open_folder(folder.empty() ? "." : folder);
  names.synchronise();
  return names.error();
}

Outcome written(const fs::path &path,
                const std::function<void(std::ostream &)> &write,
                Durability durability, const std::string &draft_ending)
{
  std::error_code status;
  const bool is_stream =
      fs::exists(path, status) && !fs::is_regular_file(path, status);
  const fs::path target = target_of(path);
  Draft draft(is_stream ? path : fs::path(target.string() + draft_ending));
  draft.is_kept = is_stream;
  FileHandle file;
  file.open_empty(draft.path);
  if (file.error() != 0)
  {
    draft.is_kept = true; // there is none
    return {file.error(), false};
  }
  FileBuffer buffer(file);
  std::ostream out(&buffer);
  write(out);
  int error = finish(file, out, durability);
  if (error == 0 && !is_stream)
    error = take_name(draft, target, durability);
  return {error, true};
}

constexpr const char *usual_ending = ".part";

void require_written(const fs::path &path, const Outcome &outcome)
{
  if (outcome.error != 0)
    throw RunFailure(write_failure(path, outcome.error));
}
} // namespace

std::string write_failure(const fs::path &path, int error)
{
  return path.string() +
         ": cannot be written: " + std::generic_category().message(error);
}

void write_whole(const fs::path &path,
                 const std::function<void(std::ostream &)> &write,
                 Durability durability)
{
  require_written(path, written(path, write, durability, usual_ending));
}

void write_shared(const fs::path &path,
                  const std::function<void(std::ostream &)> &write)
{
  require_written(path,
                  written(path, write, Durability::on_disk,
                          "." + std::to_string(::getpid()) + usual_ending));
}

void write_text(const fs::path &path, const std::string &text,
                Durability durability)
{
  write_whole(
      path, [&text](std::ostream &out) { out << text; }, durability);
}

void write_asked(const fs::path &path, const std::string &text)
{
  const Outcome outcome = written(
      path, [&text](std::ostream &out) { out << text; }, Durability::usual,
      usual_ending);
  if (outcome.error != 0 && !outcome.is_opened)
    throw InputError(write_failure(path, outcome.error));
  require_written(path, outcome);
}
} // namespace spall
