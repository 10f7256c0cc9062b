#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace spall
{
struct Case;
struct KindReport;
class List;
class Test;

/// Where a value of a case was set: "case.prm:12" by section and key.
using SourceLocation =
    std::function<std::string(const std::string &, const std::string &)>;

/// Where the parameters are set that a case sets: "case.prm:12" by Section/key.
using SetLocations = std::map<std::string, std::string>;

/// A section of a case file.
struct Section
{
  std::string name, sentence;
  std::vector<std::string> old_names = {}; ///< deprecated, still read
};

/// A kind of test: everything that the program needs. A new kind is one
/// such entry, made in the folder of the kind, and its line in
/// test/registry.cc (docs/developer/extending.md).
struct TestKind
{
  std::string name; ///< value of Case/kind
  /// Sections that only this kind has, in the order of printing.
  std::vector<Section> sections;
  /// Of the sections that some kinds share (case/fields.cc), those it has.
  std::vector<std::string> shared_sections;
  /// Adds the keys of its sections, and its own keys of common sections.
  void (*add_parameters)(List &list, Case &of) = nullptr;
  /// Sets what differs from the defaults of a Case.
  void (*set_defaults)(Case &defaults) = nullptr;
  /// Sets what a template shows besides these defaults; may be null.
  void (*set_template)(Case &defaults) = nullptr;
  /// Checks its parameters against each other and against the files they name.
  /// Throws InputError.
  void (*check)(const Case &parameters,
                const SourceLocation &location) = nullptr;
  /// A line for each value within its texts and files that is allowed and
  /// likely a slip (case/notices.h), once all is checked; may be null.
  std::vector<std::string> (*notices)(const Case &parameters,
                                      const SetLocations &set) = nullptr;
  /// Builds the scene. Throws InputError.
  std::unique_ptr<Test> (*make)(const Case &parameters) = nullptr;
  /// Its particles can be spread over ranks: rows and decisions are sums over
  /// what each rank has (dem/measure/totals.h).
  bool runs_on_many_ranks = false;
  /// Section/key = value of a case of such a kind that keeps it on one rank,
  /// empty if there is none; may be null.
  std::string (*needs_one_rank)(const Case &parameters) = nullptr;
  std::string seed_key; ///< Section/key of the seed of its particles
  /// Section with the key `gradation` of its particles; empty: it has none.
  std::string gradation_section = {};
  /// Parameters, besides those with the flag may_change, that a resumed run may
  /// change: Section/key.
  std::vector<std::string> may_change = {};
  const KindReport &(*report)() = nullptr; ///< headlines, table, charts
};

/// All kinds, the default of Case/kind first.
const std::vector<TestKind> &test_kinds();

/// Adds a kind that is not among those of the program. Throws
/// std::invalid_argument if there is one of its name.
void add_test_kind(TestKind kind);

/// The kind of this name, or null.
const TestKind *find_kind(const std::string &name);

/// The names of all kinds.
std::vector<std::string> kind_names();
} // namespace spall
