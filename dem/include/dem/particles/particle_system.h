#pragma once

#include <dem/particles/periodic_cell.h>
#include <dem/shape/particle_shape.h>

#include <array>
#include <cstdint>
#include <vector>

namespace dem
{
/// What the force loops read of a particle: two cache lines.
struct alignas(64) ParticleState
{
  Vec3 position = Vec3::Zero(); ///< of the equivalent sphere [m]
  double radius = 0.;           ///< of the equivalent sphere [m]
  Vec3 velocity = Vec3::Zero(); ///< [m/s]
  /// rho V, times ParticleSystem::mass_factor: what is accelerated [kg].
  double mass = 0.;
  Vec3 spin = Vec3::Zero(); ///< world frame [rad/s]
  double inertia = 0.;      ///< of the equivalent sphere, 2/5 m r^2 [kg m^2]
  /// Body to world. Spheres keep theirs in a scene without shapes.
  Quaternion orientation = Quaternion::Identity();
};

/// What acts on a particle, gravity and local damping left out: one cache line.
struct alignas(64) ParticleLoad
{
  Vec3 force = Vec3::Zero();      ///< [N]
  Vec3 moment = Vec3::Zero();     ///< about the centre [N m]
  std::array<double, 2> unused{}; ///< so that equal loads have equal bytes

  ParticleLoad &operator+=(const ParticleLoad &other)
  {
    force += other.force;
    moment += other.moment;
    return *this;
  }
};

/// What turning needs of a particle in a scene with shapes: one cache line.
struct alignas(64) TurningFrame
{
  Vec3 moments = Vec3::Ones(); ///< principal moments of inertia [kg m^2]
  /// |v| + reach |omega|: no gap of the particle closes faster [m].
  double reach = 0.;
  Quaternion principal = Quaternion::Identity(); ///< principal frame to body
};

/// The particles in columns; entry k of every column is the same particle. Many
/// particles are put in spatial order from time to time: `id` says which is
/// where.
struct ParticleSystem
{
  std::vector<std::int64_t> id;
  std::vector<ParticleState> state;
  std::vector<ParticleShape> shape;
  std::vector<double> initial_mass; ///< rho V before any breakage [kg]
  /// Density that is accelerated over that of the solid: above 1 with density
  /// scaling (particles/density_scaling.h) [-].
  std::vector<double> mass_factor;
  std::vector<std::uint8_t> is_breakable;
  std::vector<std::uint8_t> material; ///< 0: EngineParameters::particle
  std::vector<ParticleLoad> load;
  std::vector<TurningFrame> frame; ///< empty unless has_shapes
  bool has_shapes = false;         ///< some particle is not a sphere
  bool has_materials = false;      ///< some particle is not of material 0
  /// Particles meet with their true surfaces: they turn with the inertia
  /// tensors of their bodies, not of spheres.
  bool follows_surfaces = false;
  /// How far any point of the particle, or its radius towards another particle,
  /// may have come since construction; kept in scenes with shapes [m].
  std::vector<double> path_length;

  PeriodicCell cell; ///< not there: particles meet where they are

  /// Particles of other ranks that owned ones meet: the last rows. Their loads
  /// are sent to the ranks that own them. None on one rank.
  std::size_t n_ghosts = 0;

  std::size_t size() const { return id.size(); } ///< with ghosts
  /// Particles of this rank: the first rows.
  std::size_t n_owned() const { return size() - n_ghosts; }
  /// From particle a to the nearest image of particle b [m].
  Vec3 branch(std::size_t a, std::size_t b) const
  {
    const Vec3 direct = state[b].position - state[a].position;
    return cell.is_there() ? cell.nearest(direct) : direct;
  }
  /// Velocity of that image against the particle a [m/s].
  Vec3 relative_velocity(std::size_t a, std::size_t b) const
  {
    const Vec3 direct = state[b].velocity - state[a].velocity;
    return cell.is_there()
               ? Vec3(direct + cell.image_velocity(state[b].position -
                                                   state[a].position))
               : direct;
  }
  /// Whether a comes before b in a pair: the particle that was lighter at
  /// first, of equal ones that of the smaller id. No number that a step
  /// computes depends on the order of the columns therefore.
  bool is_junior(std::size_t a, std::size_t b) const
  {
    return initial_mass[a] != initial_mass[b]
               ? initial_mass[a] < initial_mass[b]
               : id[a] < id[b];
  }
  /// Not as a sphere does; spheres among spheres turn as spheres.
  bool turns_as_tensor() const { return follows_surfaces && has_shapes; }

  ParticleState &last() { return state.back(); }
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
  /// rho V, without density scaling [kg].
  double solid_mass(std::size_t k) const { return mass(k) / mass_factor[k]; }
  double &inertia(std::size_t k) { return state[k].inertia; }
  const double &inertia(std::size_t k) const { return state[k].inertia; }
  /// Body to world.
  Mat3 rotation(std::size_t k) const
  {
    return state[k].orientation.toRotationMatrix();
  }
  /// One field of all particles, copied.
  template <class Field>
  std::vector<Field> column(Field ParticleState::*field) const
  {
    std::vector<Field> all;
    all.reserve(size());
    for (const ParticleState &one : state)
      all.push_back(one.*field);
    return all;
  }
  /// Inertia tensor times spin, and the inverse of the tensor times a moment.
  Vec3 angular_momentum(std::size_t k) const;                 ///< [N m s]
  Vec3 over_inertia(std::size_t k, const Vec3 &moment) const; ///< [rad/s^2]
  double kinetic_energy(std::size_t k) const;                 ///< [J]
  double smallest_moment(std::size_t k) const;                ///< [kg m^2]
  double smallest_mass() const;                               ///< [kg]
  double smallest_radius() const; ///< of the spheres [m]
  double largest_radius() const;  ///< of the spheres [m]

  /// Appends a particle at rest; its id is its row.
  void add(const ParticleShape &particle, const Vec3 &at,
           const Quaternion &turned, double density, double factor = 1.);

  /// Mass, inertia, equivalent radius and frame from the body [density of the
  /// solid in kg/m^3].
  void update_mass(std::size_t k, double density);
  /// The frames of all particles from their bodies.
  void renew_frames();

  /// Calls call(column) for every column but `shape` and `frame`, in a fixed
  /// order.
  template <class Self, class Visit>
  static void visit(Self &self, const Visit &call)
  {
    call(self.id);
    call(self.state);
    call(self.initial_mass);
    call(self.mass_factor);
    call(self.is_breakable);
    call(self.material);
    call(self.load);
    call(self.path_length);
  }

  /// Entry k becomes entry order[k].
  void reorder(const std::vector<std::int32_t> &order);

private:
  void set_frame(std::size_t k);
};

/// The same for any column of the particles.
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
