#pragma once

#include <coupling/deformable_body.h>
#include <fem/plate_body.h>

#include <functional>

namespace coupling
{
/// What moves a rigid body besides the particles, over time [s].
struct RigidDrive
{
  /// Force and moment about the centre of mass, weight included; none: zero.
  std::function<fem::PlateLoad(double)> load;
  /// Displacement of the translations that forces do not move [m]; none: zero.
  std::function<Eigen::Vector3d(double)> path;
};

/// A rigid body behind the nodes of a surface that moves with it.
class RigidBody : public DeformableBody
{
public:
  RigidBody(const fem::PlateBodyParameters &parameters, const Field &nodes,
            RigidDrive drive, const BodySteps &steps = {});
  const fem::PlateBody &plate() const { return body; }

  NodeMotion motion() const override { return {position, velocity}; }
  std::vector<double> nodal_mass() const override; ///< infinite: no light node
  void begin_step(double time_step) override;
  void end_step(FieldView load, double time_step) override;
  double stable_time_step() const override;
  double squared_frequency(std::span<const double> stiffness) const override;
  BodyEnergy energy() const override;
  void save(std::ostream &out) const override;
  void restore(std::istream &in) override;

private:
  void start(FieldView load) override;
  void implicit_step(FieldView load, double time_step) override;
  fem::PlateLoad driven(double at) const;
  fem::PlateLoad sum_of(FieldView load) const;
  void read_motion();

  fem::PlateBodyParameters parameters;
  fem::PlateBody body;
  Field reference;
  RigidDrive drive;
  double time = 0.; ///< of the body [s]
  Field position, velocity;
};
} // namespace coupling
