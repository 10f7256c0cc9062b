#include "run/folder.h"

#include "errors.h"

#include <charconv>
#include <system_error>

namespace spall
{
namespace fs = std::filesystem;

namespace
{
std::ofstream open_file(const fs::path &path, std::ios::openmode mode)
{
  std::ofstream stream(path, mode);
  if (!stream)
    throw RunFailure(path.string() + ": cannot be written");
  return stream;
}

/// What is written at some moments of a run, each into a file of its own.
void remove_reports(const fs::path &folder)
{
  std::error_code status;
  std::vector<fs::path> old;
  for (const fs::directory_entry &entry :
       fs::directory_iterator(folder, status))
    for (const char *start : {"roundness_", "boundary_profile_"})
      if (entry.path().filename().string().starts_with(start))
        old.push_back(entry.path());
  for (const fs::path &path : old)
    fs::remove(path, status);
}

/// Shortest text that reads back as the same number.
std::string exact(double value)
{
  char text[32];
  const auto [end, status] = std::to_chars(text, text + sizeof text, value);
  return {text, end};
}
} // namespace

void CsvFile::open(const fs::path &path, const std::string &header)
{
  name = path;
  stream = open_file(path, std::ios::binary | std::ios::trunc);
  stream << header << '\n';
}

void CsvFile::resume(const fs::path &path, std::uint64_t size)
{
  name = path;
  stream.close(); // what it still holds goes into the file now, not later
  std::error_code status;
  if (fs::file_size(path, status) < size || status)
    throw RunFailure(path.string() +
                     ": shorter than when the checkpoint was written");
  fs::resize_file(path, size);
  stream = open_file(path, std::ios::binary | std::ios::app);
}

void CsvFile::write_row(const std::vector<double> &values)
{
  std::string line;
  for (const double value : values)
    line += (line.empty() ? "" : ",") + exact(value);
  stream << line << '\n';
  if (!stream)
    throw RunFailure(name.string() + ": cannot be written (disk full?)");
}

std::uint64_t CsvFile::flushed_size()
{
  stream.flush();
  if (!stream)
    throw RunFailure(name.string() + ": cannot be written (disk full?)");
  return fs::file_size(name);
}

void prepare_run_folder(const fs::path &folder, bool is_resumed)
{
  std::error_code status;
  if (fs::exists(folder) && !fs::is_directory(folder))
    throw InputError("--out " + folder.string() +
                     ": is a file: must be a folder");
  if (fs::exists(folder) && !fs::is_empty(folder) &&
      !fs::exists(folder / "case.prm"))
    throw InputError("--out " + folder.string() +
                     ": holds something that is no run: must be empty, new or "
                     "the folder of an earlier run");
  if (!is_resumed)
    for (const char *old : {"history.csv", "events.csv", "ledger.csv",
                            "cycles.csv", "summary.json", "run.pvd",
                            "report.html", "frames", "checkpoint", "log.txt"})
      fs::remove_all(folder / old, status);
  if (!is_resumed)
    remove_reports(folder);
  for (const fs::path &made :
       {folder, folder / "frames", folder / "checkpoint"})
  {
    fs::create_directories(made, status);
    if (!fs::is_directory(made))
      throw InputError("--out " + folder.string() +
                       ": cannot be made: must be a folder that may be "
                       "written");
  }
}

void write_text(const fs::path &path, const std::string &text)
{
  const fs::path draft = path.string() + ".part";
  {
    std::ofstream stream = open_file(draft, std::ios::binary);
    stream << text;
    stream.close();
    if (!stream)
      throw RunFailure(path.string() + ": cannot be written (disk full?)");
  }
  fs::rename(draft, path);
}
} // namespace spall
