#include "run/folder.h"

#include "errors.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
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

[[noreturn]] void refuse(const fs::path &folder, const std::string &what)
{
  throw InputError("--out " + folder.string() + ": " + what);
}

/// Of the result files of all kinds, those with a number or time in their name
/// by how it starts.
bool is_result(const std::string &name)
{
  constexpr std::array files = {
      "history.csv", "events.csv", "ledger.csv",   "cycles.csv", "transfer.csv",
      "profile.csv", "bowl.csv",   "summary.json", "run.pvd",    "view.py",
      "report.html", "frames",     "checkpoint",   "log.txt"};
  return std::ranges::find(files, name) != files.end() ||
         name.starts_with("roundness_") ||
         name.starts_with("boundary_profile_") || name.starts_with("sections_");
}

void remove_results(const fs::path &folder)
{
  std::error_code status;
  std::vector<fs::path> old;
  for (const fs::directory_entry &entry :
       fs::directory_iterator(folder, status))
    if (is_result(entry.path().filename().string()))
      old.push_back(entry.path());
  for (const fs::path &path : old)
    fs::remove_all(path, status);
}

/// Throws if a new run would take something away that is to stay.
void check_free(const fs::path &folder, const RunOptions &options)
{
  std::error_code status;
  const fs::path resolved = folder / "case.prm",
                 checkpoint = folder / "checkpoint" / "state.bin";
  if (fs::equivalent(resolved, options.case_file, status))
    refuse(folder, "holds the case file itself, which the run would "
                   "overwrite: must be another folder");
  const bool is_run =
      fs::exists(resolved) &&
      (fs::exists(folder / "history.csv") || fs::exists(folder / "checkpoint"));
  if (fs::exists(folder) && !fs::is_empty(folder) && !is_run)
    refuse(folder, "holds something that is no run: must be empty, new or "
                   "the folder of an earlier run");
  if (fs::exists(checkpoint) && !holds_complete_run(folder) &&
      !options.is_overwriting)
    refuse(folder, "holds a run that is not finished, with " +
                       checkpoint.string() +
                       ": --resume goes on with it, --overwrite begins anew; "
                       "else another folder");
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
  const std::uintmax_t found = fs::file_size(path, status);
  if (status || found < size)
    throw InputError("--resume: " + path.string() + ": " +
                     (status ? "is missing"
                             : "is shorter than when the checkpoint was "
                               "written"));
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

bool holds_complete_run(const fs::path &folder)
{
  std::ifstream in(folder / "summary.json");
  const auto summary = nlohmann::json::parse(in, nullptr, false);
  return summary.is_object() && summary.value("is_complete", false);
}

void prepare_run_folder(const RunOptions &options)
{
  const fs::path folder = options.out;
  if (fs::exists(folder) && !fs::is_directory(folder))
    refuse(folder, "is a file: must be a folder");
  if (!options.is_resumed)
  {
    check_free(folder, options);
    remove_results(folder);
  }
  std::error_code status;
  for (const fs::path &made :
       {folder, folder / "frames", folder / "checkpoint"})
  {
    fs::create_directories(made, status);
    if (!fs::is_directory(made))
      refuse(folder, "cannot be made: must be a folder that may be written");
  }
}
} // namespace spall
