#pragma once

#include "triaxial/load_path.h"

#include <array>
#include <cstdint>
#include <iosfwd>
#include <limits>

namespace spall
{
/// What a specimen shows, compression positive.
struct LoadMeasures
{
  double time = 0.;         ///< [s]
  double axial_strain = 0.; ///< since loading began [-]
  double height = 0.;       ///< [m]
  double plate_speed = 0.;  ///< downward [m/s]
  double volume = 0.;       ///< [m^3]
  double axial_stress = 0.; ///< of the particles on the plate [Pa]
  double drive_stress = 0.; ///< force on the plate over the section [Pa]
  std::array<double, 2> side_stress = {}; ///< [Pa]
  std::array<double, 2> side_strain = {}; ///< since loading began [-]
};

/// Where a stage is at the end of the coming step.
struct StagePosition
{
  double cycles = 0.;        ///< of the stage [-]
  double phase = 0.;         ///< of the present cycle [-]
  double cycles_before = 0.; ///< as `cycles`, at the start of the step [-]
  double step = 0.;          ///< [s]
};

/// A stage that has begun.
struct StageRun
{
  double time = 0.;          ///< it began [s]
  double cycles_before = 0.; ///< of all stages before it [-]
  double period = 0.;        ///< of its cycles [s]
  std::int64_t is_over = 0;  ///< all of its cycles have been, or
  std::int64_t is_met = 0;   ///< its end condition has been met
};

/// Follows a loading path: from the present stage and what is measured it makes
/// the targets of plate and sides. It moves nothing itself.
class LoadFollower
{
public:
  /// Stresses before loading are the confining pressure [Pa].
  LoadFollower(LoadPath path, double confining_pressure);

  const LoadPath &path() const { return stages; }
  const LoadStage &stage() const { return stages.stages[index()]; }
  std::size_t index() const { return static_cast<std::size_t>(state.stage); }
  bool is_last() const { return index() + 1 == stages.stages.size(); }
  /// The stages that have begun.
  const std::vector<StageRun> &runs() const { return begun; }
  bool is_over() const { return !begun.empty() && begun.back().is_over != 0; }
  double cycles_before() const
  {
    return begun.empty() ? 0. : begun.back().cycles_before;
  }
  /// Load cycles at a time [-].
  double cycles_at(double time) const;

  /// Length of a cycle of the present stage [s].
  double period() const { return state.period; }
  /// The plate is moved, not loaded.
  bool is_driven() const { return state.is_driven != 0; }

  /// Begins the first stage, or the next one; `cycles` of all before it.
  void begin(const LoadMeasures &now, double cycles);
  /// The length of its cycles in whole steps [s].
  void round_period(double period) { begun.back().period = period; }
  /// Takes in the stresses at the start of a step of the length [s];
  /// `response_time` is that of their running means [s].
  void observe(const LoadMeasures &now, double step, double response_time);
  /// Sets the targets for the end of the step.
  void aim(const StagePosition &end);
  /// Sets targets before loading [Pa].
  void aim_at(double isotropic_stress);
  /// Ends the stage where its cycles or its condition say so.
  void end_interval(const LoadMeasures &now, double cycles,
                    double unbalanced_ratio);
  /// Another number of cycles in the path may let a finished stage continue.
  void update_end(double cycles);

  /// Targets; NaN where a motion is prescribed [Pa].
  double axial_target() const { return state.axial_target; }
  double side_target(int d) const
  {
    return state.side_target[static_cast<std::size_t>(d)];
  }
  /// Of a driven plate, upward; `first_height` is that of the specimen when
  /// loading began [m/s^2].
  double plate_acceleration(const LoadMeasures &now, const StagePosition &end,
                            double first_height) const;
  /// The side is moved at side_rate(), not loaded.
  bool is_side_moved(int d) const
  {
    return state.is_moved[static_cast<std::size_t>(d)] != 0;
  }
  /// Shortening of a side over its present length [1/s].
  double side_rate(int d, const LoadMeasures &now, double response_time) const;

  void save(std::ostream &out) const;
  /// Throws std::runtime_error where a stage that has begun is another one in
  /// the present path.
  void restore(std::istream &in);

private:
  /// Plain data for the checkpoint.
  struct State
  {
    std::int64_t stage = 0;
    std::int64_t is_driven = 0;                ///< see is_driven()
    std::array<std::int64_t, 2> is_moved = {}; ///< see is_side_moved()
    double period = 0.;                        ///< [s]
    double axial_from = 0., axial_to = 0.;     ///< [Pa]
    double axial_base = 0.;                    ///< target without wave [Pa]
    double strain_from = 0., strain_to = 0.;   ///< [-]
    double speed_from = 0.;                    ///< of the plate, down [m/s]
    std::array<double, 2> side_from = {}, side_to = {}; ///< [Pa] or [-]
    std::array<double, 2> side_base = {};               ///< as axial_base [Pa]
    double leading_from = 0.; ///< axial stress that sides follow [Pa]
    double volume_from = 0.;  ///< [m^3]
    double ratio_from = 0.;   ///< q / p [-]
    double mean_axial = 0., mean_side = 0.; ///< running means [Pa]
    double axial_target = 0.;               ///< [Pa]
    std::array<double, 2> side_target = {}; ///< [Pa]
  };

  void begin_axial(const LoadMeasures &now);
  void begin_side(std::size_t d, const LoadMeasures &now);
  double stage_length() const;
  double leading_stress() const;
  double stress_ratio() const;
  bool is_met(const LoadMeasures &now, double unbalanced_ratio) const;

  LoadPath stages;
  State state;
  std::vector<StageRun> begun;
};
} // namespace spall
