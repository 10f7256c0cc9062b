#pragma once

#include <coupling/gain.h>
#include <coupling/interface_map.h>
#include <dem/engine.h>

namespace coupling
{
/// Wall-clock spent in the membrane and in the exchange [s].
struct DriverClock
{
  double membrane = 0., transfer = 0.;
};

/// A tube-shaped membrane round the stones, tied to a fixed rim below and to a
/// plate above, in step with the engine: begin_step, Engine::advance, end_step
/// with one time step is velocity Verlet of the whole. Motion and load are
/// exchanged in every step.
class MembraneDriver
{
public:
  /// Ties the nodes at the lowest and the highest z of the mesh and attaches
  /// the surface to the engine.
  MembraneDriver(const fem::MembraneParameters &parameters,
                 const fem::SurfaceMesh &mesh, dem::Engine &engine);

  void set_pressure(double pressure) { membrane.set_pressure(pressure); }

  /// Membrane to the end of the step; the upper rim moves with `rim_speed`
  /// along z [m/s]; its surface is handed to the engine.
  void begin_step(dem::Engine &engine, double rim_speed, double time_step);
  /// Loads of the stones on the membrane, then its second half.
  void end_step(const dem::Engine &engine, double time_step);

  /// Force of the membrane on what holds its upper rim, along z [N].
  double rim_reaction() const;
  /// Mass of the upper rim, moved by the plate [kg].
  double rim_mass() const;
  double enclosed_volume() const { return membrane.enclosed_volume(); }
  fem::MembraneEnergy energy() const { return membrane.energy(); }
  double unbalanced_force_ratio() const
  {
    return membrane.unbalanced_force_ratio();
  }
  void write_vtu(const std::string &path) const { membrane.write_vtu(path); }

  /// Both sides of the interface when the last step exchanged loads.
  const InterfaceBalance &balance() const { return last_balance; }
  /// Gain of the exchange in the present state (see gain.h).
  ExchangeGain gain(const dem::Engine &engine, double time_step) const;
  /// Of the membrane alone, by Lanczos iteration; costs some ten steps [s].
  double stable_time_step() const { return membrane.stable_time_step(); }
  /// dem::contact_springs() with the nodes as points.
  dem::SpringNetwork springs(const dem::Engine &engine, double horizon) const;
  DriverClock clock() const { return spent; }

  void save(std::ostream &out) const; ///< bit for bit
  void restore(std::istream &in);     ///< throws std::runtime_error

private:
  fem::Membrane membrane;
  InterfaceMap map;
  std::vector<std::int32_t> upper_rim;
  std::vector<Eigen::Vector3d> nodal_load;
  InterfaceBalance last_balance;
  DriverClock spent;
};
} // namespace coupling
