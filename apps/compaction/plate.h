#pragma once

#include "case/case.h"

#include <coupling/exchange.h>
#include <coupling/rigid_body.h>
#include <coupling/solid_body.h>

#include <limits>

namespace spall
{
/// Weight and exciter of the plate, from the time it is let go; it vibrates
/// after the seating time.
coupling::RigidDrive plate_drive(const PlateParameters &plate,
                                 const VibrationParameters &vibration);

/// The elastic plate, its lower face at this height [m]: layer 0 is the plate
/// alone, layer 1, within the load radius, has the mass that it carries too.
/// Its axis is guided along z. Throws InputError if the plate alone has more
/// mass than Plate/mass.
fem::Solid elastic_plate(const Case &parameters, double height);

/// The plate once it is joined to the particles: a plane, or a disc with nodes.
/// A disc is guided at first: its speed is at most Plate/seating_speed, the
/// less the more of it the particles carry, v = v0 (1 - F / W) but for its
/// inertia.
class CompactionPlate
{
public:
  // Bodies hold its address.
  CompactionPlate(const CompactionPlate &) = delete;
  CompactionPlate &operator=(const CompactionPlate &) = delete;
  /// Adds it to `joined`, its lower face at this height [m]; a rigid one is the
  /// plane of that number and let go, the others are guided.
  CompactionPlate(const Case &parameters, double height, std::size_t plane,
                  coupling::Exchange &joined, dem::Engine &engine);

  bool is_disc() const { return its_form != PlateKind::rigid; }
  /// Whether the particles carry it, so that it may be let go.
  bool is_carried(const dem::Engine &engine) const;
  /// At this time of the body, since it was joined [s].
  void release(double time) { free_from = time; }
  /// At this time since it was let go; before, there is no exciter [s].
  void start_exciter(double time);

  double height() const;                           ///< of its lower face [m]
  double velocity() const;                         ///< of it, up [m/s]
  double tilt() const;                             ///< to the level [rad]
  double bending() const;                          ///< off its mean plane [m]
  double load(const dem::Engine &engine) const;    ///< of the particles, up [N]
  double impulse(const dem::Engine &engine) const; ///< of it [N s]
  coupling::BodyEnergy energy() const { return body->energy(); }
  const coupling::DeformableBody &coupled() const { return *body; }
  /// Null unless it bends.
  const coupling::SolidBody *elastic() const { return solid; }

private:
  void add_rigid(const dem::Vec3 &position, std::size_t plane,
                 coupling::Exchange &joined, dem::Engine &engine);
  std::unique_ptr<coupling::DeformableBody>
  make_tilting(const fem::SurfaceMesh &face, double radius);
  std::unique_ptr<coupling::DeformableBody>
  make_elastic(fem::Solid disc, const CouplingParameters &c);
  double force(double time) const; ///< along z, guide included [N]
  double weight() const;           ///< load included [N]
  double guide() const;            ///< force over speed [N s/m]
  std::array<double, 2> slopes() const;

  PlateKind its_form;
  PlateParameters plate;
  VibrationParameters vibration;
  coupling::RigidDrive drive;
  /// Time of the body when it was let go [s].
  double free_from = std::numeric_limits<double>::infinity();
  coupling::DeformableBody *body = nullptr;
  coupling::RigidBody *rigid = nullptr; ///< if it tilts
  coupling::SolidBody *solid = nullptr; ///< if it bends
  std::size_t boundary = 0;             ///< number of its plane or surface
  std::vector<double> shares;           ///< of its lower face, by node [-]
};
} // namespace spall
