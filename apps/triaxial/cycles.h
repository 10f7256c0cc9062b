#pragma once

#include "case/case.h"
#include "test/test.h"
#include "triaxial/load_path.h"
#include "triaxial/network_state.h"
#include "triaxial/sample.h"
#include "triaxial/stage_row.h"

#include <dem/measure/hysteresis.h>

#include <nlohmann/json_fwd.hpp>

#include <iosfwd>

namespace spall
{
/// What a load cycle has left; a row of cycles.csv. Plain data.
struct CycleRow
{
  Sample end;             ///< strains, abrasion, roundness at its end
  double stands_for = 1.; ///< cycles: itself and those skipped before it [-]
  double resilient_strain = 0., resilient_modulus = 0., damping_ratio = 0.;
  double n_events = 0.; ///< in the cycle [-]
  double in_stage = 0.; ///< cycle of its stage of the loading path [-]
  /// Lost in the cycle [J].
  double friction = 0., rolling = 0., damping = 0., breakage = 0.;
  /// Of the cycle, signs as in history.csv [J].
  double external_work = 0., non_conservative_work = 0., energy_residual = 0.;
  NetworkState peak, rest; ///< half through the cycle and at its end
};

/// The table of the load cycles, built up row by row of the history, and the
/// profiles at both ends of the loading.
class CycleRecorder
{
public:
  CycleRecorder(LoadForm form, const LoadPath &path);

  /// cycles.csv, of cyclic loading alone, and stages.csv, of a path from a
  /// file.
  std::vector<TableHeader> tables() const;
  std::vector<TableRow> take_rows(); ///< of them, since the last call
  /// Profiles since the last call.
  std::vector<NamedText> take_files();
  /// Takes in a row of the history while loading, at a interval: begins and
  /// ends cycles, notes the profiles where loading begins and ends.
  void take(const Triaxial &test, const Sample &row);
  /// The interval half through a cycle.
  void take_peak(const Triaxial &test);
  /// Adds the last cycle, the contacts and the porosities.
  void add_to(nlohmann::ordered_json &summary) const;

  void save(std::ostream &out) const;
  void restore(std::istream &in);

private:
  void begin_cycle(const Sample &row);
  void end_cycle(const Triaxial &test, const Sample &row);
  void add_cycle_row();
  void end_stage(const Triaxial &test, const Sample &row);

  /// Next to the lateral boundary and inside, and the outline [-].
  struct Packed
  {
    double porosity_skin = 0., porosity_inside = 0.;
    double coordination_skin = 0., coordination_inside = 0.;
    double bulge = 0.;
  };
  /// The profiles of this moment become files, `when` in their names.
  Packed note_profiles(const Triaxial &test, const std::string &when);

  /// Plain data for the checkpoint.
  struct State
  {
    Sample begun; ///< the row that the present cycle began with
    dem::Hysteresis loop;
    NetworkState start; ///< of loading
    double skin = 0.;   ///< then [m]
    NetworkState peak;  ///< of the present cycle; NaN before
    CycleRow last;      ///< the last complete one
    double n_cycles = 0.;
    LoopMeans last_loops; ///< of the present stage
    Packed packed_start, packed_end;
  };

  bool is_cyclic, has_path;
  State state;
  std::vector<TableRow> rows;
  std::vector<NamedText> files;
};
} // namespace spall
