#pragma once

#include "case/file.h"
#include "study/expectation.h"

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace spall
{
/// Section of the key whose values are the names of variants.
inline const std::string variant_key = "Variants";

/// A swept parameter and its values as text.
struct SweptKey
{
  std::string section, key; ///< key is empty for variants
  std::vector<std::string> values;
  std::string location; ///< in the study file
  std::string unit;     ///< of the key, "-" if none; empty for variants

  bool is_variant() const { return section == variant_key; }
  /// Of a figure.
  std::string id() const
  {
    return is_variant() ? section : section + "_" + key;
  }
  std::string name() const
  {
    return is_variant() ? section : section + "/" + key;
  }
  /// A value with the unit.
  std::string with_unit(const std::string &value) const
  {
    return unit.empty() || unit == "-" ? value : value + " " + unit;
  }
};

/// Some keys of the case that take their values together.
struct Variant
{
  std::string name;
  std::vector<Override> settings;
};

/// How the values of the keys are put together: each key by itself around the
/// base case, that for every variant, or all combinations.
enum class Combine
{
  each,
  each_variant,
  grid
};

/// What makes a difference count: 5 % of the mean of all, or that it exceeds
/// its 95 % interval over the seeds.
enum class JudgedBy
{
  means,
  seeds
};

/// Two columns of a file that every case writes, say over the distance from a
/// boundary.
struct Profile
{
  std::string file, x, y;
};

/// A sweep of cases, from a study file.
struct Study
{
  std::string file;      ///< as given
  std::string case_file; ///< base case, found
  std::string title = "study";
  Combine combine = Combine::each;
  JudgedBy judged_by = JudgedBy::means;
  /// Outcomes that are costs, the first the one that counts. With them the base
  /// case is the reference of an error map and runs too.
  std::vector<std::string> costs;
  /// Variants that are the base case but for last digits: they show what chaos
  /// makes, and are no choice.
  std::vector<std::string> controls;
  std::vector<Override> base; ///< settings of every case
  std::string seed_key;       ///< Section/key
  std::vector<std::string> seeds;
  /// More of them for the reference alone, so that its spread is known better.
  std::vector<std::string> spread_seeds;
  std::vector<std::string> outcomes; ///< keys of summary.json
  /// Load cycles after which the statements are tested too, rising.
  std::vector<int> after_cycles;
  std::string curve_x, curve_y; ///< columns of history.csv; may be empty
  std::vector<Profile> profiles;
  std::string measured; ///< file with points beside the curve; may be empty
  std::vector<SweptKey> keys; ///< `variant_key` first, if there are variants
  std::vector<Variant> variants;
  std::vector<Expectation> expectations;
  std::vector<std::string> deprecated; ///< a line for each old name in use

  bool has_reference() const { return !costs.empty(); }
};

/// One case of a study.
struct StudyPoint
{
  std::vector<std::string> values; ///< requested, of the keys in their order
  /// Those that the case has: a variant may set others than the base.
  std::vector<std::string> values_in_case;
  std::string seed;
  std::vector<int> sweeps; ///< keys that it is a point of
  bool is_base = false;    ///< no key has another value than the base case
  std::string folder;      ///< name in that of the study, by its index at first
  std::vector<Override> overrides;
  std::string resolved;             ///< the case as it will be run
  std::vector<std::string> notices; ///< of its case
};

/// `overrides` are settings of every case that come after those of the file.
/// Throws InputError: file, section, key, value, what is allowed.
Study read_study(const std::string &file,
                 const std::vector<Override> &overrides = {});

/// Every case once. Throws InputError if one of them is no case.
std::vector<StudyPoint> points_of(const Study &study);

/// The notices of all points, each once.
std::vector<std::string> notices_of(const std::vector<StudyPoint> &points);

/// Of the folder of a case with this number.
std::string run_name(std::size_t number);

/// Names the folder of each point: the one in the folder of the study that
/// holds its case, whatever its number, and else one that holds nothing.
void find_folders(std::vector<StudyPoint> &points,
                  const std::filesystem::path &folder);

/// Whether the folder of the study has the whole run of this point.
bool is_finished(const StudyPoint &point, const std::filesystem::path &folder);

/// How a case ended.
struct PointResult
{
  bool is_done = false;
  std::string fault;            ///< its message, if it failed
  std::vector<double> outcomes; ///< NaN where it gives none
  /// The same after each of `Study::after_cycles`.
  std::vector<std::vector<double>> outcomes_after = {};
};

/// Numbers of the points in the order in which they run: every case of as many
/// seeds as there are jobs before the next seeds, so that cases which are
/// compared meet a machine in the same load state, and a seed is prepared by
/// its first case while the other jobs have seeds of their own.
std::vector<std::size_t> running_order(const std::vector<StudyPoint> &points,
                                       int jobs);

/// One of several shares of a study, each run by a program of its own.
struct StudyPart
{
  std::size_t number = 1; ///< from 1
  std::size_t n_parts = 1;
};

/// Every point is in one part; sizes of parts differ by one at most. A part is
/// a stretch of the running order of one job, so that few parts prepare the
/// same specimen.
std::vector<StudyPoint> part_of(const std::vector<StudyPoint> &points,
                                const StudyPart &part);

/// How the cases of a study run.
struct StudyRuns
{
  int jobs = 1;    ///< cases at a time
  int ranks = 1;   ///< of each case that can be spread over ranks
  int threads = 1; ///< of each rank, at most
  std::vector<std::string> mpirun = {"mpirun"}; ///< words that start ranks
  /// Called once, with the first case that is done and what it gave.
  std::function<void(const StudyPoint &, const PointResult &)> after_first;
};

/// Runs what is not done yet as programs of their own in the order above; a run
/// with a checkpoint is resumed. A case that fails does not stop the others;
/// SIGINT and SIGTERM do, each with its checkpoint. Cases that prepare the same
/// specimen share it, in the folder `preparations`.
std::vector<PointResult> run_points(const Study &study,
                                    const std::vector<StudyPoint> &points,
                                    const std::filesystem::path &folder,
                                    const StudyRuns &how);

/// study.csv: one row per case. Throws RunFailure.
void write_study_table(const Study &study,
                       const std::vector<StudyPoint> &points,
                       const std::vector<PointResult> &results,
                       const std::filesystem::path &path);

/// The cases of a study with what they gave.
struct StudyData
{
  const Study &study;
  std::span<const StudyPoint> points;
  std::span<const PointResult> results;
};

/// The report as one HTML page; charts also as files into `figures` unless it
/// is empty.
std::string study_page(const StudyData &data,
                       const std::filesystem::path &folder,
                       const std::filesystem::path &figures);
} // namespace spall
