#pragma once

#include <coupling/deformable_body.h>
#include <fem/condensed.h>
#include <fem/solid_surface.h>

#include <functional>

namespace coupling
{
BodyEnergy energy_of(const fem::SolidEnergy &energy);

/// What moves an elastic body besides the particles, over time [s].
struct SolidDrive
{
  std::function<double(double)> force; ///< along z, in all [N]
  std::vector<double> share;           ///< of it on each node of the body [-]
};

/// An elastic body touched on one part of its surface.
class SolidBody : public DeformableBody
{
public:
  /// `boundary` as SolidMesh::Face.
  SolidBody(fem::Solid its_solid, std::int32_t boundary,
            const BodySteps &steps);
  const fem::SurfaceMesh &mesh() const { return surface.mesh; }
  fem::Solid &solid() { return body; }
  const fem::Solid &solid() const { return body; }
  /// On all nodes of the body, besides the particles: weight, for one [N]. It
  /// acts from now on. Throws std::invalid_argument.
  void set_dead_load(Field load);
  /// Acts from now on, time 0 of the body. Throws std::invalid_argument.
  void set_drive(SolidDrive its_drive);
  /// These loads on the surface balance what the body has settled under before
  /// [N]: what exceeds them moves it. Displacements count from there.
  void balance(FieldView load);

  NodeMotion motion() const override { return {position, velocity}; }
  /// Mass of a hanging node is with its parents: infinite here.
  std::vector<double> nodal_mass() const override;
  void begin_step(double time_step) override;
  void end_step(FieldView load, double time_step) override;
  double stable_time_step() const override
  {
    return body.stable_time_step().guaranteed;
  }
  BodyEnergy energy() const override;
  void save(std::ostream &out) const override;
  void restore(std::istream &in) override;

private:
  void start(FieldView load) override;
  void implicit_step(FieldView load, double time_step) override;
  double dead_potential() const;
  FieldView on_body(FieldView load);
  void start_books();
  void book(FieldView load);
  void read_motion();

  fem::Solid body;
  fem::SolidSurface surface;
  Field position, velocity; ///< of the surface
  Field dead_load;          ///< on the body [N]
  double dead_start = 0.;   ///< dead_potential() when it was set [J]
  SolidDrive drive;
  /// State of the particles that a drive needs.
  struct
  {
    double time = 0.; ///< of the body [s]
    double work = 0.; ///< of the particles [J]
  } driven;
  Field touching;  ///< load of the particles, last [N]
  Field before;    ///< displacements of the surface when the step began [m]
  Field body_load; ///< space to work in
};

/// A linear body condensed on the nodes of one part of its surface.
class CondensedBody : public DeformableBody
{
public:
  /// From a body at rest; `window` is that of the exchange, of which the
  /// condensed body takes steps.n implicit steps [s]. Throws as CondensedSolid.
  CondensedBody(const fem::Solid &body, std::int32_t boundary,
                int n_inner_modes, int n_steps, double window);
  const fem::SurfaceMesh &mesh() const { return surface.mesh; }
  /// As that of SolidBody. Throws std::invalid_argument.
  void balance(FieldView load);

  NodeMotion motion() const override { return {position, velocity}; }
  std::vector<double> nodal_mass() const override { return mass; }
  void begin_step(double time_step) override; ///< throws std::logic_error
  void end_step(FieldView load, double time_step) override; ///< the same
  double stable_time_step() const override;
  BodyEnergy energy() const override;
  void save(std::ostream &out) const override { reduced.save(out); }
  void restore(std::istream &in) override;

private:
  void start(FieldView load) override { reduced.set_load(excess(load)); }
  void implicit_step(FieldView load, double time_step) override;
  double rest_potential() const;
  FieldView excess(FieldView load);
  void read_motion();

  fem::SolidSurface surface;
  fem::CondensedSolid reduced;
  Field rest_load;        ///< in balance; empty: none [N]
  double rest_start = 0.; ///< rest_potential() when it was set [J]
  Field acting;           ///< space to work in
  std::vector<double> mass;
  double own_step = 0.;
  Field position, velocity;
};
} // namespace coupling
