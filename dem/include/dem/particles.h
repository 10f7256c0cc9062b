#pragma once

#include <dem/shape/body.h>

#include <cstdint>
#include <vector>

namespace dem
{
/// What the force loops read of a stone: two cache lines.
struct alignas(64) StoneState
{
  Vec3 position = Vec3::Zero(); ///< of the ball [m]
  double radius = 0.;           ///< of the ball [m]
  Vec3 velocity = Vec3::Zero(); ///< [m/s]
  double mass = 0.;             ///< rho V [kg]
  Vec3 spin = Vec3::Zero();     ///< world frame [rad/s]
  double inertia = 0.;          ///< of the ball, 2/5 m r^2 [kg m^2]
  /// Body to world. Spheres keep theirs in a scene without shapes.
  Quaternion orientation = Quaternion::Identity();
};

/// What acts on a stone, gravity and local damping left out: one cache line.
struct alignas(64) StoneLoad
{
  Vec3 force = Vec3::Zero();  ///< [N]
  Vec3 moment = Vec3::Zero(); ///< about the centre [N m]

  StoneLoad &operator+=(const StoneLoad &other)
  {
    force += other.force;
    moment += other.moment;
    return *this;
  }
};

/// What turning needs of a stone in a scene with shapes: one cache line.
struct alignas(64) TurningFrame
{
  Vec3 moments = Vec3::Ones(); ///< principal moments of inertia [kg m^2]
  /// |v| + reach |omega|: no gap of the stone closes faster [m].
  double reach = 0.;
  Quaternion principal = Quaternion::Identity(); ///< principal frame to body
};

/// The stones in columns; entry k of every column is the same stone. Many
/// stones are put in order of place from time to time: `id` says who is where.
struct Particles
{
  std::vector<std::int64_t> id;
  std::vector<StoneState> state;
  std::vector<Body> body;
  std::vector<double> initial_mass; ///< before any breakage [kg]
  std::vector<std::uint8_t> is_breakable;
  std::vector<std::uint8_t> material; ///< 0: EngineParameters::stone
  std::vector<StoneLoad> load;
  std::vector<TurningFrame> frame; ///< empty unless has_shapes
  bool has_shapes = false;         ///< some stone is not a sphere
  bool has_materials = false;      ///< some stone is not of material 0
  /// Stones meet with their true surfaces: they turn with the inertia tensors
  /// of their bodies, not of balls.
  bool follows_surfaces = false;
  /// How far any point of the stone, or its radius towards another stone, may
  /// have come since construction; kept in scenes with shapes [m].
  std::vector<double> travelled;

  std::size_t size() const { return id.size(); }
  /// Not as a ball does; spheres among spheres turn as balls.
  bool turns_as_tensor() const { return follows_surfaces && has_shapes; }

  StoneState &last() { return state.back(); }
  Vec3 &position(std::size_t k) { return state[k].position; }
  const Vec3 &position(std::size_t k) const { return state[k].position; }
  Vec3 &velocity(std::size_t k) { return state[k].velocity; }
  const Vec3 &velocity(std::size_t k) const { return state[k].velocity; }
  Vec3 &spin(std::size_t k) { return state[k].spin; }
  const Vec3 &spin(std::size_t k) const { return state[k].spin; }
  Quaternion &orientation(std::size_t k) { return state[k].orientation; }
  const Quaternion &orientation(std::size_t k) const
  {
    return state[k].orientation;
  }
  double &radius(std::size_t k) { return state[k].radius; }
  const double &radius(std::size_t k) const { return state[k].radius; }
  double &mass(std::size_t k) { return state[k].mass; }
  const double &mass(std::size_t k) const { return state[k].mass; }
  double &inertia(std::size_t k) { return state[k].inertia; }
  const double &inertia(std::size_t k) const { return state[k].inertia; }
  /// Body to world.
  Mat3 rotation(std::size_t k) const
  {
    return state[k].orientation.toRotationMatrix();
  }
  /// One field of all stones, copied.
  template <class Field>
  std::vector<Field> column(Field StoneState::*field) const
  {
    std::vector<Field> all;
    all.reserve(size());
    for (const StoneState &one : state)
      all.push_back(one.*field);
    return all;
  }
  /// Inertia tensor times spin, and the inverse of the tensor times a moment.
  Vec3 angular_momentum(std::size_t k) const;                 ///< [N m s]
  Vec3 over_inertia(std::size_t k, const Vec3 &moment) const; ///< [rad/s^2]
  double kinetic_energy(std::size_t k) const;                 ///< [J]
  double smallest_moment(std::size_t k) const;                ///< [kg m^2]
  double smallest_mass() const;                               ///< [kg]
  double smallest_radius() const; ///< of the balls [m]
  double largest_radius() const;  ///< of the balls [m]

  /// Appends a stone at rest; its id is its place.
  void add(const Body &stone, const Vec3 &at, const Quaternion &turned,
           double density);

  /// Mass, inertia, ball radius and frame from the body [density in kg/m^3].
  void update_mass(std::size_t k, double density);
  /// The frames of all stones from their bodies.
  void renew_frames();

  /// Calls call(column) for every column but `body` and `frame`, in a fixed
  /// order.
  template <class Self, class Visit>
  static void visit(Self &self, const Visit &call)
  {
    call(self.id);
    call(self.state);
    call(self.initial_mass);
    call(self.is_breakable);
    call(self.material);
    call(self.load);
    call(self.travelled);
  }

  /// Entry k becomes entry order[k].
  void reorder(const std::vector<std::int32_t> &order);

private:
  void set_frame(std::size_t k);
};

/// The same for any column of the stones.
template <class Column>
void reorder_column(Column &column, const std::vector<std::int32_t> &order)
{
  Column fresh;
  fresh.reserve(order.size());
  for (const std::int32_t from : order)
    fresh.push_back(std::move(column[static_cast<std::size_t>(from)]));
  column = std::move(fresh);
}
} // namespace dem
