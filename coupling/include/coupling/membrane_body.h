#pragma once

#include <coupling/deformable_body.h>
#include <fem/membrane.h>

namespace coupling
{
/// Mass of the nodes, infinite where they are tied or in the middle of an edge,
/// which has it at its ends [kg].
std::vector<double> movable_mass(const fem::Membrane &membrane);
BodyEnergy energy_of(const fem::MembraneEnergy &energy);

/// A membrane whose tied nodes are fixed or move as prescribed.
class MembraneBody : public DeformableBody
{
public:
  MembraneBody(fem::Membrane its_membrane, const BodySteps &steps)
      : DeformableBody(steps), sheet(std::move(its_membrane))
  {
  }
  fem::Membrane &membrane() { return sheet; }
  const fem::Membrane &membrane() const { return sheet; }

  NodeMotion motion() const override
  {
    return {sheet.positions(), sheet.velocities()};
  }
  std::vector<double> nodal_mass() const override
  {
    return movable_mass(sheet);
  }
  void begin_step(double time_step) override { sheet.begin_step(time_step); }
  void end_step(FieldView load, double time_step) override
  {
    sheet.end_step(load, time_step);
  }
  std::size_t n_sprung() const override
  {
    return is_implicit() ? sheet.n_nodes() : 0;
  }
  double stable_time_step() const override { return sheet.stable_time_step(); }
  BodyEnergy energy() const override { return energy_of(sheet.energy()); }
  void save(std::ostream &out) const override { sheet.save(out); }
  void restore(std::istream &in) override { sheet.load(in); }

private:
  void start(FieldView load) override { sheet.set_load(load); }
  void implicit_step(FieldView load, double time_step) override
  {
    sheet.advance(load, time_step);
  }
  void implicit_step(FieldView load, double time_step,
                     const fem::NodeSprings &springs) override
  {
    sheet.advance(load, time_step, fem::average_acceleration(), &springs);
  }

  fem::Membrane sheet;
};
} // namespace coupling
