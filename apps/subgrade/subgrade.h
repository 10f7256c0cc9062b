#pragma once

#include "subgrade/deflections.h"
#include "subgrade/load.h"
#include "subgrade/record.h"
#include "subgrade/scene.h"
#include "test/test.h"

#include <dem/measure/roundness_book.h>
#include <fem/ground_axis.h>

namespace spall
{
/// A plate or sleeper on particles on an elastic ground. The particles fall on
/// ground that is held and come to rest; the plate is set down on them and
/// comes to rest; then the ground is let go, in balance with what lies on it,
/// and the pulses come. Settlement and breakage count from there.
class Subgrade : public Test
{
public:
  /// Throws InputError.
  explicit Subgrade(const Case &parameters);

  double share_done() const override;     ///< of the loading
  double duration() const override;       ///< of the loading [s]
  double frame_interval() const override; ///< in it [s]
  std::string phase() const override;
  std::string outcome() const override;
  Due due() const override { return due_now; }
  double progress_at(double time) const override; ///< since loading began [s]
  const char *progress_column() const override { return "loading_time_s"; }
  void summarise(nlohmann::ordered_json &summary) const override;
  std::string preparation_text() const override;
  bool is_preparing() const override { return now.stage == Stage::pouring; }
  void save_prepared(std::ostream &out) const override;
  void take_prepared(std::istream &in) override;
  void save(std::ostream &out, dem::StateExtent extent) const override;
  void restore(std::istream &in) override;

  bool has_ledger() const override { return true; }
  const coupling::Exchange *exchange() const override { return joined.get(); }
  const SetupStep *setup_step() const override { return &setup; }
  FrameParts frame_parts() const override;
  std::vector<NamedText> take_files() override;
  const dem::Pouring *poured_by() const override { return &pouring; }
  void describe() const override;
  double preparation_time() const override;
  FastPreparation fast_preparation() override;
  int steps_in_move() const override;
  std::vector<NamedBoundary> named_boundaries() const override;

private:
  enum class Stage : std::int32_t
  {
    pouring,
    placing,
    loading,
    done
  };
  /// Numbers that a checkpoint stores as they are.
  struct State
  {
    Stage stage = Stage::pouring;
    double placed_at = 0.;    ///< [s]
    double loaded_at = 0.;    ///< [s]
    double plate_start = 0.;  ///< lower face where it was set down [m]
    double plate_rest = 0.;   ///< centre when loading began [m]
    double height = 0.;       ///< of the layer then [m]
    double porosity = 0.;     ///< of the layer then [-]
    double coordination = 0.; ///< then [-]
    double dead_load = 0.;    ///< on the ground then, down [N]
    EnergyBalance energies;   ///< then
    double lowest = 0.;       ///< largest settlement of the plate [m]
    double deepest = 0.;      ///< of the ground [m]
    double fastest = 0.;      ///< particle [m/s]
    double worst_gain = 0.;   ///< [-]
    double peak_force = 0.;   ///< of the particles on the ground, down [N]
    double density = 0.;      ///< below the plate when loading began [kg/m^3]
    double roundness = 1.;    ///< then, mean of the particles [-]
  };

  Subgrade(const Case &parameters, ParticleBox its_scene);
  void move(double time_step) override;
  std::vector<Quantity> measured() const override;
  coupling::BodyEnergy body_energy() const override;
  std::vector<dem::BreakageEvent> fresh_events() override;
  Surroundings surroundings() const override;

  void build_ground();
  void build_axis(const fem::SolidMesh &mesh);
  void build_plate(double height);
  bool pours_by_own_steps() const
  {
    return parameters.subgrade.layer.safety > 0.;
  }
  void begin_pouring();
  void pour(double time_step);
  void steer_pouring(double time_step);
  void pack();
  void set_plate_down();
  void place(double time_step);
  void load_plate(double time_step);
  void start_loading();
  void lay_on_ground();
  void balance_ground();
  std::vector<double> stresses_under(coupling::FieldView load);
  std::vector<double> stresses() const;
  bool is_at_rest() const;
  void note_due(double before);
  void note_row();
  fem::PlateLoad plate_load(double body_time) const;
  double loading_time() const;
  double plate_settlement() const;
  double ground_settlement() const;
  double fastest_particle() const; ///< of all ranks [m/s]
  double force_on_ground() const;
  double force_on_plate() const;
  double settlement_at(std::int32_t node) const;
  double mean_settlement() const;
  std::string bowl_table() const;
  double density() const;
  void note_roundness(double time); ///< of loading [s]

  ParticleBox scene; ///< its engine is with Test
  dem::Pouring pouring;
  SetupStep setup;
  SubgradeLoad pulses;
  std::unique_ptr<coupling::Exchange> joined;
  coupling::DeformableBody *ground = nullptr;
  coupling::SolidBody *solid = nullptr; ///< null if condensed
  coupling::CondensedBody *condensed = nullptr;
  coupling::RigidBody *plate = nullptr; ///< null before it is placed
  std::pair<std::size_t, std::size_t> mesh_size;
  std::int32_t middle = 0; ///< node of the ground's top under the plate
  fem::SurfaceMesh top;    ///< of the ground
  fem::GroundAxis axis;    ///< of a full ground
  std::vector<std::string> stress_names;
  std::vector<std::int32_t> cut; ///< nodes of the top along x, ascending
  std::vector<double> area;      ///< share of the top that a node has [-]
  std::vector<double> bowl;      ///< their settlement when it was deepest [m]
  coupling::Field rest_load;     ///< on the ground when loading began [N]
  std::vector<double> dead_stress, peak_stress; ///< [Pa]
  SubgradeRecord record;
  Deflections deflections;
  State now;
  Due due_now;
  std::vector<NamedText> files; ///< to be written
  mutable dem::RoundnessBook roundness;
};
} // namespace spall
