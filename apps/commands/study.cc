#include "study/study.h"

#include "commands/commands.h"
#include "errors.h"
#include "report/run_data.h"
#include "report/text_table.h"
#include "run/whole_file.h"
#include "study/page_tables.h"
#include "study/programs.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iostream>
#include <iterator>
#include <optional>
#include <sstream>
#include <thread>

namespace spall
{
namespace
{
namespace fs = std::filesystem;

constexpr const char *page_marker = "<!-- spall study --page -->";

struct StudyOptions
{
  std::string file, out, figures, page;
  bool is_of_finished = false;   ///< runs nothing
  std::optional<StudyPart> part; ///< runs this alone, and reports nothing
  std::vector<Override> overrides;
  StudyRuns how;
};

/// A whole number from 1 up.
int count_from(const std::string &option, const std::string &text)
{
  int n = 0;
  const char *end = text.data() + text.size();
  const auto [stop, status] = std::from_chars(text.data(), end, n);
  if (status != std::errc{} || stop != end || n < 1)
    throw InputError("study: " + option + " " + text +
                     ": must be a whole number from 1 up");
  return n;
}

/// K/N.
StudyPart part_from(const std::string &text)
{
  const std::size_t slash = text.find('/');
  const auto number = [&](const std::string &digits)
  {
    std::size_t n = 0;
    const char *end = digits.data() + digits.size();
    const auto [stop, status] = std::from_chars(digits.data(), end, n);
    return status == std::errc{} && stop == end ? n : 0;
  };
  StudyPart part{0, 0};
  if (slash != std::string::npos)
    part = {number(text.substr(0, slash)), number(text.substr(slash + 1))};
  if (part.number < 1 || part.number > part.n_parts)
    throw InputError("study: --part " + text +
                     ": must be K/N with whole numbers, K from 1 to N");
  return part;
}

std::vector<std::string> words_of(const std::string &text)
{
  std::istringstream in(text);
  return {std::istream_iterator<std::string>(in), {}};
}

StudyOptions study_options(Words words)
{
  StudyOptions options;
  std::optional<int> jobs;
  for (std::size_t k = 0; k < words.size(); ++k)
  {
    const std::string &word = words[k];
    const auto value = [&]() -> const std::string &
    {
      if (k + 1 == words.size())
        throw InputError("study: " + word + ": a value must follow");
      return words[++k];
    };
    if (word == "--out")
      options.out = value();
    else if (word == "--figures")
      options.figures = value();
    else if (word == "--page")
      options.page = value();
    else if (word == "--set")
      options.overrides.push_back(parse_override(value()));
    else if (word == "--jobs")
      jobs = count_from(word, value());
    else if (word == "--finished")
      options.is_of_finished = true;
    else if (word == "--part")
      options.part = part_from(value());
    else if (word == "--threads-per-case")
      options.how.threads = count_from(word, value());
    else if (word == "--ranks-per-case")
      options.how.ranks = count_from(word, value());
    else if (word == "--mpirun")
      options.how.mpirun = words_of(value());
    else if (word.starts_with("--") || !options.file.empty())
      throw InputError("study: " + word +
                       ": must be one study file, --out DIR, --jobs N, "
                       "--finished, --part K/N, --threads-per-case N, "
                       "--ranks-per-case N, --mpirun WORDS, --figures FOLDER, "
                       "--page FILE or --set Section/key=value");
    else
      options.file = word;
  }
  if (options.file.empty())
    throw InputError("study: a study file must be given");
  if (options.part && (options.is_of_finished || !options.page.empty() ||
                       !options.figures.empty()))
    throw InputError("study: --part: writes no report: must be without "
                     "--finished, --page and --figures");
  const auto n_cores = static_cast<int>(std::thread::hardware_concurrency());
  options.how.jobs = jobs.value_or(
      std::max(1, n_cores / (options.how.ranks * options.how.threads)));
  if (options.how.mpirun.empty())
    throw InputError("study: --mpirun: must name a program");
  if (options.out.empty())
    options.out = "runs/" + fs::path(options.file).stem().string();
  return options;
}

void make_folder(const fs::path &folder)
{
  std::error_code status;
  fs::create_directories(folder, status);
  if (!fs::is_directory(folder))
    throw InputError("study: --out " + folder.string() +
                     ": must be a folder that may be written");
}

/// Throws where the folder holds something, but no study.
void check_free(const fs::path &folder)
{
  std::error_code status;
  bool is_empty = true;
  for (const fs::directory_entry &entry :
       fs::directory_iterator(folder, status))
  {
    const std::string name = entry.path().filename().string();
    if (name == "study.csv" || name.starts_with("run_"))
      return;
    is_empty = false;
  }
  if (!is_empty)
    throw InputError("study: --out " + folder.string() +
                     ": holds files that are not a study: must be empty, new "
                     "or the folder of an earlier study");
}

/// Leaves out the cases that are not finished. Throws InputError if none is.
void keep_finished(std::vector<StudyPoint> &points, const fs::path &folder)
{
  const std::size_t n = points.size();
  std::erase_if(points, [&](const StudyPoint &point)
                { return !is_finished(point, folder); });
  if (points.empty())
    throw InputError("study: --finished: " + folder.string() +
                     ": holds no finished case of this study");
  std::cout << points.size() << " of " << n << " cases are finished"
            << std::endl;
}

void announce(const Study &study, std::size_t n_cases, const StudyRuns &how)
{
  std::cout << study.title << ": " << n_cases << " cases, " << how.jobs
            << " at a time";
  if (how.ranks > 1)
    std::cout << " on " << how.ranks << " ranks each";
  if (how.threads > 1)
    std::cout << (how.ranks > 1 ? ", " : " on ") << how.threads
              << " threads each";
  std::cout << std::endl;
}

/// Short tables into the page, the full ones as files beside it.
void renew_study_page(const fs::path &page, const StudyData &data)
{
  const std::string stem = page.stem().string();
  renew_page("study", page.string(), page_marker, study_markdown(data, stem));
  for (const PageFile &file : page_files(data, stem))
    write_text(page.parent_path() / file.name, file.text);
}

/// Whether a file of this name in the folder of any case has the column.
bool is_written(const StudyData &data, const fs::path &folder,
                const std::string &file, const std::string &column)
{
  return std::ranges::any_of(
      data.points,
      [&](const StudyPoint &point)
      {
        const fs::path path = folder / point.folder / file;
        return fs::exists(path) && read_table(path).find(column);
      });
}

/// Outcomes that no case gave, and columns of curve and profiles that none has.
std::vector<std::string> unknown_names(const StudyData &data,
                                       const fs::path &folder)
{
  std::vector<std::string> unknown;
  for (std::size_t o = 0; o < data.study.outcomes.size(); ++o)
    if (std::ranges::none_of(data.results, [o](const PointResult &result)
                             { return std::isfinite(result.outcomes[o]); }))
      unknown.push_back("Study/outcomes = " + data.study.outcomes[o]);
  for (std::size_t k = 0; k < data.study.after_cycles.size(); ++k)
    if (std::ranges::none_of(data.results,
                             [k](const PointResult &result)
                             {
                               return k < result.outcomes_after.size() &&
                                      std::ranges::any_of(
                                          result.outcomes_after[k], [](double x)
                                          { return std::isfinite(x); });
                             }))
      unknown.push_back("Study/after_cycles = " +
                        std::to_string(data.study.after_cycles[k]));
  for (const std::string &column : {data.study.curve_x, data.study.curve_y})
    if (!column.empty() && !is_written(data, folder, "history.csv", column))
      unknown.push_back("Study/curve = " + column);
  for (const Profile &profile : data.study.profiles)
    for (const std::string &column : {profile.x, profile.y})
      if (!is_written(data, folder, profile.file, column))
        unknown.push_back("Study/profiles = " + profile.file + ": " + column);
  return unknown;
}

/// Throws InputError where the study uses what its cases do not have.
void check_names(const StudyData &data, const fs::path &folder)
{
  if (std::ranges::none_of(data.results, &PointResult::is_done))
    return;
  std::string said;
  for (const std::string &name : unknown_names(data, folder))
    said += (said.empty() ? "" : ", ") + name;
  if (!said.empty())
    throw InputError(data.study.file + ": " + said +
                     ": no case has it: must be keys of summary.json, columns "
                     "of history.csv and of the files of profiles; the cases "
                     "are kept");
}

/// Of the first case that is done, while the others can still be stopped.
void say_unknown_names(const Study &study, const StudyPoint &point,
                       const PointResult &result, const fs::path &folder)
{
  for (const std::string &name :
       unknown_names({study, {&point, 1}, {&result, 1}}, folder))
    std::cout << "warning: " << name << ": " << point.folder
              << " does not have it" << std::endl;
}

[[noreturn]] void fail(std::size_t n, std::ptrdiff_t n_failed,
                       const std::string &where)
{
  throw RunFailure("study: " + std::to_string(n_failed) + " of " +
                   std::to_string(n) + " cases failed, " + where +
                   "; run again to try them again");
}

/// Throws RunFailure where cases have failed.
void end_part(std::size_t n, std::ptrdiff_t n_failed)
{
  if (n_failed > 0)
    fail(n, n_failed, "as said above");
  std::cout << n << " cases of this part are finished; when all parts are, "
            << "--finished writes table and report" << std::endl;
}
} // namespace

int study_command(Words words)
{
  StudyOptions options = study_options(words);
  const Study study = read_study(options.file, options.overrides);
  std::vector<StudyPoint> points = points_of(study);
  report_deprecated(study.deprecated);
  for (const std::string &notice : notices_of(points))
    std::cout << "note: " << notice << std::endl;
  const fs::path folder = options.out;
  if (!options.page.empty())
    page_before("study", options.page, page_marker);
  check_free(folder);
  find_folders(points, folder);
  if (options.is_of_finished)
    keep_finished(points, folder);
  if (options.part)
    points = part_of(points, *options.part);
  make_folder(folder);
  if (!options.figures.empty())
    make_folder(options.figures);
  if (!options.is_of_finished)
  {
    announce(study, points.size(), options.how);
    options.how.after_first =
        [&](const StudyPoint &point, const PointResult &result)
    { say_unknown_names(study, point, result, folder); };
  }
  const std::vector<PointResult> results =
      run_points(study, points, folder, options.how);
  const auto n_failed =
      std::ranges::count(results, false, &PointResult::is_done);
  if (are_programs_stopped())
    throw RunFailure("study: stopped with " + std::to_string(n_failed) +
                     " of " + std::to_string(points.size()) +
                     " cases to go; run again to continue");
  if (options.part)
  {
    end_part(points.size(), n_failed);
    return 0;
  }
  const StudyData data{study, points, results};
  write_study_table(study, points, results, folder / "study.csv");
  write_text(folder / "report.html", study_page(data, folder, options.figures));
  if (!options.page.empty())
    renew_study_page(options.page, data);
  std::cout << (folder / "study.csv").string() << '\n'
            << (folder / "report.html").string() << std::endl;
  if (n_failed > 0)
    fail(points.size(), n_failed, "see report.html");
  check_names(data, folder);
  return 0;
}
} // namespace spall
