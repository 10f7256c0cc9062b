#pragma once

#include "compaction/plate.h"
#include "compaction/scene.h"
#include "test/test.h"

#include <coupling/membrane_body.h>
#include <dem/measure/roundness_book.h>

namespace spall
{
/// A vibratory compaction: particles are poured into a cylinder in layers and
/// tamped, a plate comes down on them, gets its weight, and vibrates.
class Compaction : public Test
{
public:
  enum class Stage : std::int32_t
  {
    filling,
    seating,  ///< the plate comes down, then its weight
    vibration ///< particles may break
  };

  /// Throws InputError.
  explicit Compaction(const Case &parameters);

  double share_done() const override;
  double duration() const override;       ///< without the filling [s]
  double period() const override;         ///< of the exciter [s]
  double frame_interval() const override; ///< without those of reports [s]
  std::string phase() const override;
  std::string outcome() const override;
  std::vector<std::string> warnings() const override;
  Due due() const override;
  double progress_at(double time) const override; ///< of the vibration [s]
  const char *progress_column() const override { return "vibration_s"; }
  bool has_ledger() const override { return true; }
  const coupling::Exchange *exchange() const override { return joined.get(); }
  const SetupStep *setup_step() const override { return &scene.setup; }
  FrameParts frame_parts() const override;
  std::vector<NamedText> take_files() override;
  const dem::Pouring *poured_by() const override { return &pouring; }
  bool has_slices() const override { return true; }
  std::optional<SliceSpace> slice_space() const override;
  int steps_in_move() const override;
  double preparation_time() const override;
  FastPreparation fast_preparation() override;
  void summarise(nlohmann::ordered_json &summary) const override;
  void stop_after(int periods) override;
  bool ends_early() const override
  {
    return last_time < parameters.vibration.duration;
  }
  std::string preparation_text() const override;
  bool is_preparing() const override { return now.stage == Stage::filling; }
  void take_prepared(std::istream &in) override;
  void save(std::ostream &out, dem::StateExtent extent) const override;
  void restore(std::istream &in) override;
  std::vector<NamedBoundary> named_boundaries() const override;

private:
  /// Results of a report besides the roundness of each particle.
  struct Report
  {
    double time = 0.; ///< of vibration [s]
    double settlement = 0., density = 0., abrasion = 0., roundness = 1.;
    double n_events = 0.;
    double coordination = 0.; ///< coordination number [-]
    double mean_force = 0.;   ///< of the contacts [N]
  };
  /// Plain data for the checkpoint.
  struct State
  {
    Stage stage = Stage::filling;
    std::int32_t stage_before = 0; ///< at the last step
    std::int64_t n_layers_before = 0;
    double time_before = 0.;     ///< at the last step [s]
    double join_time = 0.;       ///< the plate became a body; 0: not yet [s]
    double join_height = 0.;     ///< of the lower face of the plate then [m]
    double release_time = 0.;    ///< the particles carried it; 0: not yet [s]
    double vibration_start = 0.; ///< the exciter started [s]
    double start_height = 0.;    ///< the same when the vibration begins [m]
    double plane_work_gone = 0.; ///< of its plane until it was joined [J]
    double impulse = 0.;         ///< of the particles on it, of vibration [N s]
    double lift_off = 0.;        ///< time of vibration without a load on it [s]
    double peak_load = 0.; ///< of the particles on it, mean of a window [N]
    double peak_acceleration = 0.; ///< of the plate, mean of a window [m/s^2]
  };

  /// Of the plate in a window.
  struct PlateChange
  {
    double impulse = 0.;  ///< of the particles on it [N s]
    double velocity = 0.; ///< [m/s]
  };

  Compaction(const Case &parameters, CompactionScene scene);
  void move(double time_step) override;
  std::vector<Quantity> measured() const override;
  double external_work() const override;
  coupling::BodyEnergy body_energy() const override;
  Surroundings surroundings() const override;
  std::vector<dem::BreakageEvent> fresh_events() override;

  void fill(double time_step);
  void steer_filling(double time_step);
  void pack();
  double height_above_layers() const;
  std::vector<std::string> density_warnings() const;
  void hand_over(double plate_height);
  bool fills_by_own_steps() const { return parameters.filling.safety > 0.; }
  void lower_plate(double time_step);
  void join(double height);
  void release(double time);
  void wait_for_rest();
  bool is_seated() const;
  std::string unseated_text() const;
  void start_vibration();
  void build_plate();
  void build_tube();
  bool has_windows() const; ///< section Coupling applies
  coupling::ExchangeParameters exchange_rules() const;
  double plate_load() const; ///< of the particles, up [N]
  void step_joined(double time_step);
  void follow_vibration(double window, const PlateChange &change);
  void report(double due); ///< time of vibration [s]
  double weight() const;   ///< of the plate and the load on it [N]
  double vibrated() const; ///< so far [s]
  double height() const;   ///< of the particles [m]
  double volume() const;   ///< that the particles fill [m^3]
  double density() const;  ///< [kg/m^3]
  const dem::Plane &plate_plane() const;

  CompactionScene scene;
  dem::Pouring pouring;
  std::unique_ptr<coupling::Exchange> joined;
  std::unique_ptr<CompactionPlate> plate; ///< of `joined`
  coupling::MembraneBody *tube = nullptr; ///< of `joined`, flexible only
  std::vector<double> report_dues;        ///< times of vibration [s]
  double last_time = 0.;                  ///< of vibration, this run [s]
  double filled_mass = 0.;                ///< before breakage [kg]
  State now;
  std::vector<Report> reports;
  std::vector<NamedText> files;
  mutable dem::RoundnessBook roundness;
};
} // namespace spall
