#pragma once

#include "triaxial/wave.h"

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace spall
{
struct Case;

/// How one direction of a specimen is loaded.
enum class LoadControl : std::int32_t
{
  keep,   ///< a stress stays, what was moved stands still
  stress, ///< a stress, from what it is to a target
  strain  ///< a strain at a constant rate
};

/// One direction in one stage. Of target and rate one may be left out if the
/// stage has a duration, none if it has not.
struct LoadDirection
{
  LoadControl control = LoadControl::keep;
  std::optional<double> target; ///< at the end of the stage [Pa] or [-]
  std::optional<double> rate;   ///< [Pa/s] or [1/s]

  bool has_own_length() const { return target && rate; }
};

/// What moves both sides together instead of a control of their own.
enum class SideRule : std::int32_t
{
  none,
  proportional,   ///< d(lateral stress) = side_ratio d(axial stress)
  constant_volume ///< the sides yield by what the plate takes
};

/// One stage of a loading path.
struct LoadStage
{
  std::string name;
  LoadDirection axial;
  std::array<LoadDirection, 2> sides; ///< x and y
  SideRule rule = SideRule::none;
  double side_ratio = 0.; ///< of `proportional`; -1/2: constant mean stress [-]
  Wave wave;
  double amplitude = 0., side_amplitude = 0.; ///< of the wave [Pa]
  int cycles = 1;                             ///< of the wave
  double duration = 0.; ///< without a wave; 0: by target and rate [s]
  /// Axial stress is the force on the plate over the section at the start of
  /// loading, not over the present one.
  bool is_over_first_section = false;
  /// The stage ends once one of these is reached: at a sampling interval, with
  /// a wave at the end of a cycle.
  std::optional<double> until_strain;     ///< axial [-]
  std::optional<double> until_ratio;      ///< q / p [-]
  std::optional<double> until_unbalanced; ///< unbalanced force ratio [-]

  bool has_wave() const { return wave.form != WaveForm::none; }
  bool has_end() const
  {
    return until_strain || until_ratio || until_unbalanced;
  }
  /// Load cycles; a stage without a wave counts as one.
  int n_cycles() const { return has_wave() ? cycles : 1; }
};

/// The stages of a test, after its consolidation.
struct LoadPath
{
  std::vector<LoadStage> stages;

  bool has_waves() const;
  int n_cycles() const;
  /// Axial stress over strain, lateral over axial stress and the like are
  /// measured while it runs.
  bool needs_stresses() const;
};

/// The path of a case: that of its file, or its short form. Throws InputError.
LoadPath load_path_of(const Case &parameters);

/// Reads a path from a CSV file (docs/user/loading_paths.md). Throws
/// InputError with line, column and value.
LoadPath read_load_path(const std::string &path, const Case &parameters);

/// All that decides a stage, but for the number of its cycles.
std::string text_of(const LoadStage &stage);

/// Length of one cycle of each stage, from one to the next, where the strain
/// and the stresses at the start of a stage are taken to be those asked for
/// [s].
std::vector<double> expected_periods(const LoadPath &path,
                                     double confining_pressure);

/// Stress or strain that a direction has at the start of a stage: what a
/// duration and a target depend on.
double end_of(const LoadDirection &direction, double start, double duration);
/// Time that target and rate of a direction make together [s].
double own_length(const LoadDirection &direction, double start);
} // namespace spall
