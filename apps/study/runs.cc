#include "errors.h"
#include "report/run_data.h"
#include "run/folder.h"
#include "run/time_left.h"
#include "study/study.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <fcntl.h>
#include <fstream>
#include <iostream>
#include <limits>
#include <map>
#include <mutex>
#include <set>
#include <spawn.h>
#include <sstream>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

extern char **environ;

namespace spall
{
namespace
{
namespace fs = std::filesystem;

std::string text_of(const fs::path &path)
{
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

/// The last line that is not empty.
std::string last_line(const fs::path &path)
{
  std::istringstream in(text_of(path));
  std::string last;
  for (std::string line; std::getline(in, line);)
    if (!line.empty())
      last = line;
  return last;
}

nlohmann::ordered_json summary_of(const fs::path &run)
{
  return nlohmann::ordered_json::parse(text_of(run / "summary.json"), nullptr,
                                       false);
}

/// Cases in the folder of a study: the folder of each, finished ones first.
std::map<std::string, std::string> cases_in(const fs::path &folder)
{
  std::vector<std::string> names;
  std::error_code status;
  for (const fs::directory_entry &entry :
       fs::directory_iterator(folder, status))
    if (fs::exists(entry.path() / "case.prm") &&
        entry.path().filename().string().starts_with("run_"))
      names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  std::ranges::stable_partition(names, [&](const std::string &name)
                                { return holds_complete_run(folder / name); });
  std::map<std::string, std::string> cases;
  for (const std::string &name : names)
    cases.emplace(without_comments(text_of(folder / name / "case.prm")), name);
  return cases;
}

/// Whether nothing would be lost there.
bool is_free(const fs::path &folder)
{
  return !fs::exists(folder) || fs::is_empty(folder);
}

/// Runs this program on the words, standard output and error into `log`;
/// returns the exit status, or -1.
int run_program(const std::vector<std::string> &words, const fs::path &log)
{
  std::vector<char *> arguments;
  for (const std::string &word : words)
    arguments.push_back(const_cast<char *>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(),
                                   O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  pid_t child = 0;
  const int fault = posix_spawn(&child, "/proc/self/exe", &actions, nullptr,
                                arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  if (fault != 0 || waitpid(child, &status, 0) != child)
    return -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// Whether the folder has this case, begun or ended.
bool holds_case(const StudyPoint &point, const fs::path &run)
{
  return without_comments(text_of(run / "case.prm")) ==
         without_comments(point.resolved);
}

/// Runs the case of a point, or goes on with it.
PointResult run_point(const StudyPoint &point, const fs::path &folder)
{
  PointResult result;
  const fs::path run = folder / point.folder,
                 file = folder / (point.folder + ".prm"),
                 log = folder / (point.folder + ".log");
  const bool is_same = holds_case(point, run);
  if (!is_same || !holds_complete_run(run))
  {
    write_text(file, point.resolved);
    const std::string shared = folder / "preparations";
    std::vector<std::string> words = {
        "spall",     "run", file.string(),    "--out", run.string(),
        "--threads", "1",   "--preparations", shared};
    if (is_same && fs::exists(run / "checkpoint" / "state.bin"))
      words.emplace_back("--resume");
    if (const int status = run_program(words, log); status != 0)
    {
      result.fault = "status " + std::to_string(status) + ": " + last_line(log);
      return result;
    }
  }
  result.is_done = true;
  return result;
}

/// How far the cases are, and how long those that are left will take: as long
/// as those that were run, not found.
class StudyProgress
{
public:
  explicit StudyProgress(std::size_t n_cases) : n(n_cases) {}

  /// Takes one case that has ended, `was_there` before or not.
  void take(const StudyPoint &point, const PointResult &result, bool was_there)
  {
    const std::lock_guard lock(output);
    ++n_done;
    n_run += !was_there;
    std::cout << n_done << "/" << n << " " << point.folder
              << (result.is_done ? "" : " failed: ") << result.fault;
    if (n_run > 0 && n_done < n)
      std::cout << ", about "
                << in_minutes(seconds() / static_cast<double>(n_run) *
                              static_cast<double>(n - n_done))
                << " left";
    std::cout << std::endl;
  }

private:
  double seconds() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() -
                                         start)
        .count();
  }

  std::size_t n, n_done = 0, n_run = 0;
  std::chrono::steady_clock::time_point start =
      std::chrono::steady_clock::now();
  std::mutex output;
};

/// NaN where the summary has no such number.
std::vector<double> outcomes_of(const Study &study, const fs::path &run)
{
  const auto summary = summary_of(run);
  std::vector<double> values;
  for (const std::string &name : study.outcomes)
    values.push_back(summary.is_object()
                         ? number(summary, name)
                         : std::numeric_limits<double>::quiet_NaN());
  return values;
}
} // namespace

void find_folders(std::vector<StudyPoint> &points, const fs::path &folder)
{
  const auto cases = cases_in(folder);
  std::set<std::string> taken;
  std::vector<StudyPoint *> others;
  for (StudyPoint &point : points)
    if (const auto found = cases.find(without_comments(point.resolved));
        found != cases.end())
      taken.insert(point.folder = found->second);
    else
      others.push_back(&point);
  std::size_t number = points.size();
  for (StudyPoint *point : others)
  {
    while (taken.contains(point->folder) || !is_free(folder / point->folder))
      point->folder = run_name(++number);
    taken.insert(point->folder);
  }
}

std::vector<PointResult> run_points(const Study &study,
                                    const std::vector<StudyPoint> &points,
                                    const fs::path &folder, int jobs)
{
  std::vector<PointResult> results(points.size());
  std::atomic<std::size_t> next = 0;
  StudyProgress progress(points.size());
  const auto work = [&]
  {
    for (std::size_t k = next++; k < points.size(); k = next++)
    {
      const fs::path run = folder / points[k].folder;
      const bool was_there =
          holds_case(points[k], run) && holds_complete_run(run);
      try
      {
        results[k] = run_point(points[k], folder);
      }
      catch (const std::exception &error)
      {
        results[k].fault = error.what();
      }
      results[k].outcomes = outcomes_of(study, run);
      progress.take(points[k], results[k], was_there);
    }
  };
  std::vector<std::jthread> workers;
  for (int j = 0; j < jobs; ++j)
    workers.emplace_back(work);
  workers.clear(); // joins
  return results;
}

void write_study_table(const Study &study,
                       const std::vector<StudyPoint> &points,
                       const std::vector<PointResult> &results,
                       const fs::path &path)
{
  std::ostringstream out;
  out.precision(12);
  out << "run,is_done_1";
  for (const SweptKey &key : study.keys)
    out << ',' << key.name();
  out << ",seed";
  for (const std::string &outcome : study.outcomes)
    out << ',' << outcome;
  out << '\n';
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    out << points[k].folder << ',' << results[k].is_done;
    for (const std::string &value : points[k].values_in_case)
      out << ',' << value;
    out << ',' << points[k].seed;
    for (const double value : results[k].outcomes)
      out << ',' << value;
    out << '\n';
  }
  write_text(path, out.str());
}
} // namespace spall
