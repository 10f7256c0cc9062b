#pragma once

#include "case/file.h"

#include <filesystem>
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
  std::string place; ///< in the study file

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
};

/// Some keys of the case that take their values together.
struct Variant
{
  std::string name;
  std::vector<Override> settings;
};

/// What runs are expected to show: how an outcome goes with a parameter.
struct Expectation
{
  std::string name;
  std::string outcome;  ///< key of summary.json
  std::string relation; ///< one of `relations`
  std::string key;      ///< Section/key
};

/// rises, falls: over the whole sweep, from value to value at most against it
/// by the spread of the seeds; changes, stays: range over mean above or below
/// 5 %; settles_low, settles_high: the two smallest or largest values within
/// 5 %.
inline const std::vector<std::string> relations = {
    "rises", "falls", "changes", "stays", "settles_low", "settles_high"};

/// A sweep of cases, from a study file.
struct Study
{
  std::string file;      ///< as given
  std::string case_file; ///< base case, found
  std::string title = "study";
  bool is_grid = false; ///< all combinations; else each key by itself
  std::string seed_key; ///< Section/key
  std::vector<std::string> seeds;
  std::vector<std::string> outcomes; ///< keys of summary.json
  std::string curve_x, curve_y;      ///< columns of history.csv; may be empty
  std::vector<SweptKey> keys; ///< `variant_key` first, if there are variants
  std::vector<Variant> variants;
  std::vector<Expectation> expectations;
};

/// One case of a study.
struct StudyPoint
{
  std::vector<std::string> values; ///< of the keys, in their order
  std::string seed;
  std::vector<int> sweeps; ///< keys that it is a point of
  std::string folder;      ///< name in the folder of the study
  std::vector<Override> overrides;
  std::string resolved; ///< the case as it will be run
};

/// Throws InputError: file, section, key, value, what is allowed.
Study read_study(const std::string &file);

/// Every case once. Throws InputError if one of them is no case.
std::vector<StudyPoint> points_of(const Study &study);

/// How a case ended.
struct PointResult
{
  bool is_done = false;
  std::string fault;            ///< what it said, if it failed
  std::vector<double> outcomes; ///< NaN where it gives none
};

/// Runs what is not done yet as programs of their own, `jobs` at a time, each
/// with one thread; a run with a checkpoint is resumed. A case that fails does
/// not stop the others. Cases that prepare the same specimen share it, in the
/// folder `preparations`.
std::vector<PointResult> run_points(const Study &study,
                                    const std::vector<StudyPoint> &points,
                                    const std::filesystem::path &folder,
                                    int jobs);

/// study.csv: one row per case. Throws RunFailure.
void write_study_table(const Study &study,
                       const std::vector<StudyPoint> &points,
                       const std::vector<PointResult> &results,
                       const std::filesystem::path &path);

/// The report as one HTML page; charts also as files into `figures` unless it
/// is empty.
std::string study_page(const Study &study,
                       const std::vector<StudyPoint> &points,
                       const std::vector<PointResult> &results,
                       const std::filesystem::path &folder,
                       const std::filesystem::path &figures);
} // namespace spall
