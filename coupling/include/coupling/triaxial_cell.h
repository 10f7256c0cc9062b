#pragma once

#include <coupling/interface_adapter.h>
#include <coupling/membrane_body.h>
#include <fem/plate.h>

#include <optional>

namespace coupling
{
/// What closes a specimen: a rigid plate that moves along z and, if there is
/// one, a tube-shaped membrane tied to it above and to a fixed rim below. Its
/// nodes are those of the membrane, then the plate.
class TriaxialCell : public DeformableBody
{
public:
  /// `plate_mass` without that of the rim, which the plate carries [kg].
  TriaxialCell(double plate_mass, double height,
               std::optional<fem::Membrane> membrane,
               const BodySteps &steps = {});

  const fem::RigidPlate &plate() const { return lid; }
  bool has_membrane() const { return tube.has_value(); }
  /// Throws std::bad_optional_access without one.
  const fem::Membrane &membrane() const { return tube.value(); }

  /// Puts the plate into a state, as RigidPlate::set_state.
  void set_plate(const fem::RigidPlate::State &state);
  /// Force along z at the end of the coming window; it comes evenly [N].
  void set_drive(double force);
  /// Instead of a force: the drive is what this acceleration needs in the
  /// coming window, whatever the plate meets [m/s^2].
  void set_acceleration(double acceleration);
  void set_pressure(double pressure); ///< on the membrane [Pa]
  /// Shifts all nodes at once, the plate along z, at no cost in energy() [m].
  void displace(FieldView shift);
  /// Force of the membrane on the plate, along z [N].
  double rim_reaction() const;

  NodeMotion motion() const override { return {position, velocity}; }
  std::vector<double> nodal_mass() const override;
  void begin_step(double time_step) override;
  void end_step(FieldView load, double time_step) override;
  /// Those of the membrane.
  std::size_t n_sprung() const override
  {
    return tube && is_implicit() ? tube->n_nodes() : 0;
  }
  double stable_time_step() const override;
  BodyEnergy energy() const override;
  void save(std::ostream &out) const override;
  void restore(std::istream &in) override;

private:
  void start(FieldView load) override;
  void implicit_step(FieldView load, double time_step) override;
  void implicit_step(FieldView load, double time_step,
                     const fem::NodeSprings &springs) override;
  void step_tube(FieldView load, double time_step,
                 const fem::NodeSprings *springs);
  void move_lid(double time_step);
  void finish_lid(FieldView load, double time_step);
  double rim_mass() const;
  void read_motion();

  std::optional<fem::Membrane> tube;
  std::vector<std::int32_t> upper_rim;
  double mass; ///< of the plate with its rim [kg]
  fem::RigidPlate lid;
  double drive_from = 0., drive_to = 0.; ///< of the window [N]
  std::optional<double> led;             ///< acceleration, if it is given
  int step_in_window = 0;
  double pressed = 0.; ///< by the particles on the plate, last [N]
  double pushed = 0.;  ///< their work on it [J]
  Field position, velocity;
};

/// Ties the rims of a tube, the nodes at its lowest and at its highest z.
fem::Membrane tube_between_rims(const fem::MembraneParameters &parameters,
                                const fem::SurfaceMesh &mesh);

/// A plane and, if the cell has a membrane, a facet surface named "membrane",
/// which is added to the engine.
std::unique_ptr<InterfaceAdapter> adapter_of(const TriaxialCell &cell,
                                             std::size_t plane,
                                             const dem::WallMaterial &contact,
                                             dem::Engine &engine);
} // namespace coupling
