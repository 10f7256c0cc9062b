#pragma once

#include <dem/shape/body.h>

#include <cstdint>
#include <vector>

namespace dem
{
/// State of the stones in columns; entry k of every column is the same stone.
/// Stones are kept in the order of their ids.
struct Particles
{
  std::vector<std::int64_t> id;
  std::vector<Vec3> position;          ///< of the ball [m]
  std::vector<Vec3> velocity;          ///< [m/s]
  std::vector<Vec3> spin;              ///< world frame [rad/s]
  std::vector<Quaternion> orientation; ///< body to world
  std::vector<Mat3> rotation;          ///< of orientation; derived each step
  std::vector<Body> body;
  std::vector<double> radius;       ///< of the ball [m]
  std::vector<double> mass;         ///< rho V [kg]
  std::vector<double> inertia;      ///< of the ball, 2/5 m r^2 [kg m^2]
  std::vector<double> initial_mass; ///< before any breakage [kg]
  std::vector<std::uint8_t> is_breakable;
  std::vector<Vec3> force;  ///< [N]
  std::vector<Vec3> moment; ///< [N m]

  std::size_t size() const { return id.size(); }

  /// Appends a stone at rest; its id is its place.
  void add(const Body &stone, const Vec3 &at, const Quaternion &turned,
           double density);

  /// Mass, inertia and ball radius from the body [density in kg/m^3].
  void update_mass(std::size_t k, double density);
};
} // namespace dem
