#include "run/folder.h"

#include "errors.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <fstream>
#include <regex>
#include <system_error>
#include <vector>

namespace spall
{
namespace fs = std::filesystem;

namespace
{
[[noreturn]] void refuse(const fs::path &folder, const std::string &what)
{
  throw InputError("--out " + folder.string() + ": " + what);
}

constexpr std::array checkpoint_names = {"state.bin", "stopped.bin",
                                         "before_jump.bin"};

/// The name of the file that a draft is to become; of others the name itself.
std::string without_part(const std::string &name)
{
  const std::string ending = ".part";
  return name.ends_with(ending) ? name.substr(0, name.size() - ending.size())
                                : name;
}

/// Of the result files of all kinds, those with a number or time in their name
/// by how it starts.
bool is_result(const std::string &name)
{
  constexpr std::array files = {"gradation.csv", "history.csv", "events.csv",
                                "ledger.csv",    "cycles.csv",  "transfer.csv",
                                "profile.csv",   "bowl.csv",    "pulses.csv",
                                "summary.json",  "run.pvd",     "view.py",
                                "report.html",   "log.txt"};
  return std::ranges::find(files, name) != files.end() ||
         (name.ends_with(".csv") &&
          (name.starts_with("roundness_") ||
           name.starts_with("boundary_profile_") ||
           name.starts_with("sections_") || name.starts_with("slices_")));
}

/// NAME_NNNNN.vtu, the index NAME_NNNNN.pvtu of its pieces NAME_NNNNN_RRRR.vtu,
/// or tables_NNNNN.h5
bool is_frame(const std::string &name)
{
  static const std::regex pictures("[^0-9]+_[0-9]+(_[0-9]+)?\\.vtu|"
                                   "[^0-9]+_[0-9]+\\.pvtu|"
                                   "tables_[0-9]+\\.h5");
  return std::regex_match(name, pictures);
}

/// Files and drafts in the folder whose name is one of those.
template <class IsOurs>
std::vector<fs::path> files_in(const fs::path &folder, const IsOurs &is_ours)
{
  std::error_code status;
  std::vector<fs::path> files;
  for (const fs::directory_entry &entry :
       fs::directory_iterator(folder, status))
    if (!entry.is_directory(status) &&
        is_ours(without_part(entry.path().filename().string())))
      files.push_back(entry.path());
  return files;
}

/// The checkpoint first: as long as it is there the run can be resumed. The
/// subfolders stay, by which a run is known.
void remove_results(const fs::path &folder)
{
  const auto is_checkpoint = [](const std::string &name) {
    return std::ranges::find(checkpoint_names, name) != checkpoint_names.end();
  };
  std::vector<fs::path> old = files_in(folder / "checkpoint", is_checkpoint);
  for (const auto &more :
       {files_in(folder / "frames", is_frame), files_in(folder, is_result)})
    old.insert(old.end(), more.begin(), more.end());
  for (const fs::path &path : old)
  {
    std::error_code status;
    fs::remove(path, status);
    if (status)
      refuse(folder, path.string() + " of the earlier run cannot be removed: " +
                         status.message());
  }
}

bool holds_run(const fs::path &folder)
{
  return fs::exists(folder / "case.prm") &&
         (fs::exists(folder / "history.csv") ||
          fs::exists(folder / "checkpoint"));
}

/// Of what is made before case.prm, in a folder with both subfolders or not.
bool is_first_trace(const fs::directory_entry &entry, bool has_subfolders)
{
  std::error_code status;
  const std::string name = entry.path().filename().string();
  if (name == "frames" || name == "checkpoint")
    return entry.is_directory(status) && fs::is_empty(entry.path(), status);
  if (name == "log.txt")
    return entry.is_regular_file(status) && entry.file_size(status) == 0;
  return name == "case.prm.part" && has_subfolders;
}

/// Throws if a new run would take something away that is to stay.
void check_free(const fs::path &folder, const RunOptions &options)
{
  std::error_code status;
  const fs::path state = folder / "checkpoint" / "state.bin",
                 stopped = folder / "checkpoint" / "stopped.bin";
  if (fs::equivalent(folder / "case.prm", options.case_file, status))
    refuse(folder, "holds the case file itself, which the run would "
                   "overwrite: must be another folder");
  if (fs::exists(folder) && !holds_run(folder) && !holds_first_traces(folder))
    refuse(folder, "holds files that are not a run: must be empty, new or "
                   "the folder of an earlier run");
  if (holds_complete_run(folder) || options.is_overwriting)
    return;
  if (fs::exists(state))
    refuse(folder, "holds a run that is not finished, with " + state.string() +
                       ": --resume continues it, --overwrite starts again; "
                       "else another folder");
  if (fs::exists(stopped))
    refuse(folder, "holds the state in which a run was stopped, " +
                       stopped.string() +
                       ": --resume continues from it once it has the name "
                       "state.bin, --overwrite starts from the beginning; "
                       "else another folder");
}
} // namespace

bool holds_complete_run(const fs::path &folder)
{
  std::ifstream in(folder / "summary.json");
  const auto summary = nlohmann::json::parse(in, nullptr, false);
  return summary.is_object() && summary.value("is_complete", false);
}

bool holds_first_traces(const fs::path &folder)
{
  std::error_code status;
  const bool has_subfolders = fs::is_directory(folder / "frames", status) &&
                              fs::is_directory(folder / "checkpoint", status);
  return fs::is_directory(folder, status) &&
         std::ranges::all_of(fs::directory_iterator(folder, status),
                             [=](const fs::directory_entry &entry)
                             { return is_first_trace(entry, has_subfolders); });
}

std::string start_over_if_interrupted(RunOptions &options)
{
  const fs::path folder = options.out;
  std::error_code status;
  const bool has_state =
      fs::exists(folder / "checkpoint" / "state.bin", status) ||
      fs::exists(folder / "checkpoint" / "stopped.bin", status) ||
      fs::exists(folder / "summary.json", status);
  const bool is_interrupted =
      (holds_run(folder) && !has_state) || holds_first_traces(folder);
  if (!is_interrupted || (!options.is_resumed && fs::is_empty(folder, status)))
    return "";
  options.is_resumed = false;
  return folder.string() + ": the earlier run in this folder ended before its "
                           "first checkpoint: this run starts from the "
                           "beginning";
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
