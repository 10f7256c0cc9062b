#include "errors.h"
#include "report/run_data.h"
#include "run/folder.h"
#include "run/time_left.h"
#include "run/whole_file.h"
#include "study/after_cycles.h"
#include "study/programs.h"
#include "study/study.h"
#include "test/checkpoint.h"
#include "test/test.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <fstream>
#include <iostream>
#include <limits>
#include <map>
#include <mutex>
#include <numeric>
#include <set>
#include <sstream>
#include <thread>

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

/// The case of a run as this program writes it: one that was run before there
/// was a key has the default of that key. What is no case any more is as it is.
std::string case_of(const fs::path &run)
{
  const fs::path file = run / "case.prm";
  try
  {
    return without_comments(resolved_case(read_case(file.string(), {})));
  }
  catch (const InputError &)
  {
    return without_comments(text_of(file));
  }
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
  std::stable_partition(names.begin(), names.end(),
                        [&](const std::string &name)
                        { return holds_complete_run(folder / name); });
  std::map<std::string, std::string> cases;
  for (const std::string &name : names)
    cases.emplace(case_of(folder / name), name);
  return cases;
}

/// Whether nothing would be lost there.
bool is_free(const fs::path &folder)
{
  return !fs::exists(folder) || holds_first_traces(folder);
}

/// Whether the folder has this case, run by a program that knew every key of
/// it.
bool has_all_keys(const StudyPoint &point, const fs::path &run)
{
  return without_comments(text_of(run / "case.prm")) ==
         without_comments(point.resolved);
}

/// Whether the folder has this case, begun or ended.
bool holds_case(const StudyPoint &point, const fs::path &run)
{
  return has_all_keys(point, run) ||
         case_of(run) == without_comments(point.resolved);
}

/// What comes before the words of a run: this program, on several ranks if the
/// case can be spread over them.
std::vector<std::string> launch_words(const StudyRuns &how,
                                      const fs::path &file)
{
  if (how.ranks == 1 || !needs_one_rank(read_case(file.string(), {})).empty())
    return {"spall"};
  std::vector<std::string> words = how.mpirun;
  words.insert(words.end(), {"-n", std::to_string(how.ranks),
                             fs::read_symlink("/proc/self/exe").string()});
  return words;
}

/// Runs the case of a point, or continues it.
PointResult run_point(const StudyPoint &point, const fs::path &folder,
                      const StudyRuns &how)
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
    std::vector<std::string> words = launch_words(how, file);
    words.insert(words.end(),
                 {"run", file.string(), "--out", run.string(), "--threads",
                  std::to_string(how.threads), "--preparations", shared});
    if (const fs::path state = run / "checkpoint" / "state.bin";
        is_same && fs::exists(state))
      words.emplace_back(is_of_this_version(state) && has_all_keys(point, run)
                             ? "--resume"
                             : "--overwrite");
    if (const int status = run_program(words, log); status != 0)
    {
      result.fault =
          status < 0
              ? words.front() + " was not started, or was killed"
              : "status " + std::to_string(status) + ": " + last_line(log);
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
  StudyProgress(std::size_t n_cases, std::size_t n_found)
      : n(n_cases), n_to_run(n_cases - n_found)
  {
  }

  /// Takes one case that has ended, or was found.
  void take(const StudyPoint &point, const PointResult &result, bool is_found)
  {
    const std::lock_guard lock(output);
    ++n_done;
    n_run += !is_found;
    std::cout << n_done << "/" << n << " " << point.folder;
    const bool is_stopped = are_programs_stopped();
    if (n_run > 0 && n_run < n_to_run && !is_stopped)
      std::cout << ", about "
                << in_minutes(seconds() / static_cast<double>(n_run) *
                              static_cast<double>(n_to_run - n_run))
                << " left";
    std::cout << (result.is_done ? ""
                  : is_stopped   ? ", stopped: "
                                 : ", failed: ")
              << result.fault << std::endl;
  }

private:
  double seconds() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() -
                                         start)
        .count();
  }

  std::size_t n, n_to_run, n_done = 0, n_run = 0;
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

bool is_finished(const StudyPoint &point, const fs::path &folder)
{
  return holds_case(point, folder / point.folder) &&
         holds_complete_run(folder / point.folder);
}

std::vector<std::size_t> running_order(const std::vector<StudyPoint> &points,
                                       int jobs)
{
  std::map<std::string, std::size_t> index_of_seed;
  for (const StudyPoint &point : points)
    index_of_seed.try_emplace(point.seed, index_of_seed.size());
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {},
                           [&](std::size_t k) {
                             return index_of_seed.at(points[k].seed) /
                                    static_cast<std::size_t>(jobs);
                           });
  return order;
}

std::vector<StudyPoint> part_of(const std::vector<StudyPoint> &points,
                                const StudyPart &part)
{
  const std::vector<std::size_t> order = running_order(points, 1);
  const auto end_of = [&](std::size_t number)
  { return number * points.size() / part.n_parts; };
  std::vector<StudyPoint> mine;
  for (std::size_t k = end_of(part.number - 1); k < end_of(part.number); ++k)
    mine.push_back(points[order[k]]);
  return mine;
}

std::vector<PointResult> run_points(const Study &study,
                                    const std::vector<StudyPoint> &points,
                                    const fs::path &folder,
                                    const StudyRuns &how)
{
  std::vector<PointResult> results(points.size());
  const std::vector<std::size_t> order = running_order(points, how.jobs);
  pass_on_stops();
  std::atomic<std::size_t> next = 0;
  std::atomic_flag has_first;
  std::vector<char> is_found(points.size());
  for (std::size_t k = 0; k < points.size(); ++k)
    is_found[k] = is_finished(points[k], folder);
  StudyProgress progress(
      points.size(),
      static_cast<std::size_t>(std::ranges::count(is_found, char{1})));
  const auto work = [&]
  {
    for (std::size_t n = next++; n < order.size() && !are_programs_stopped();
         n = next++)
    {
      const std::size_t k = order[n];
      const fs::path run = folder / points[k].folder;
      try
      {
        results[k] = run_point(points[k], folder, how);
      }
      catch (const std::exception &error)
      {
        results[k].fault = error.what();
      }
      results[k].outcomes = outcomes_of(study, run);
      for (const int cycle : study.after_cycles)
        results[k].outcomes_after.push_back(
            outcomes_after(cycle, study.outcomes, run));
      progress.take(points[k], results[k], is_found[k] != 0);
      if (results[k].is_done && how.after_first && !has_first.test_and_set())
        how.after_first(points[k], results[k]);
    }
  };
  std::vector<std::jthread> workers;
  for (int j = 0; j < how.jobs; ++j)
    workers.emplace_back(work);
  workers.clear(); // joins
  return results;
}

namespace
{
/// In quotes where a comma, a quote or a new line would end it (RFC 4180).
std::string csv_cell(const std::string &value)
{
  if (value.find_first_of(",\"\n\r") == std::string::npos)
    return value;
  std::string cell = "\"";
  for (const char c : value)
    cell += c == '"' ? "\"\"" : std::string(1, c);
  return cell + '"';
}
} // namespace

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
  for (const int cycle : study.after_cycles)
    for (const std::string &outcome : study.outcomes)
      out << ',' << outcome << "_after_" << cycle;
  out << '\n';
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    out << points[k].folder << ',' << results[k].is_done;
    for (const std::string &value : points[k].values_in_case)
      out << ',' << csv_cell(value);
    out << ',' << points[k].seed;
    for (const double value : results[k].outcomes)
      out << ',' << value;
    for (const std::vector<double> &values : results[k].outcomes_after)
      for (const double value : values)
        out << ',' << value;
    out << '\n';
  }
  write_text(path, out.str());
}
} // namespace spall
