#include <dem/particles/particle_system.h>

#include <algorithm>

namespace dem
{
namespace
{
bool is_lighter(const ParticleState &a, const ParticleState &b)
{
  return a.mass < b.mass;
}

bool is_smaller(const ParticleState &a, const ParticleState &b)
{
  return a.radius < b.radius;
}
} // namespace

void ParticleSystem::add(const ParticleShape &particle, const Vec3 &at,
                         const Quaternion &turned, double density,
                         double factor)
{
  id.push_back(static_cast<std::int64_t>(id.size()));
  shape.push_back(particle);
  has_shapes |= particle.series != nullptr;
  ParticleState &fresh = state.emplace_back();
  fresh.position = at;
  fresh.orientation = turned;
  mass_factor.push_back(factor);
  update_mass(size() - 1, density);
  initial_mass.push_back(density * particle.volume);
  is_breakable.push_back(0);
  material.push_back(0);
  load.emplace_back();
  path_length.push_back(0.);
  if (has_shapes && frame.size() + 1 < size())
    renew_frames();
  else if (has_shapes)
  {
    frame.emplace_back();
    set_frame(size() - 1);
  }
}

void ParticleSystem::update_mass(std::size_t k, double density)
{
  ParticleState &particle = state[k];
  particle.radius = mean_radius(shape[k]);
  particle.mass = mass_factor[k] * density * shape[k].volume;
  particle.inertia = 0.4 * particle.mass * particle.radius * particle.radius;
  if (k < frame.size())
    set_frame(k);
}

void ParticleSystem::renew_frames()
{
  frame.resize(has_shapes ? size() : 0);
  for (std::size_t k = 0; k < frame.size(); ++k)
    set_frame(k);
}

void ParticleSystem::set_frame(std::size_t k)
{
  const ParticleShape &of = shape[k];
  // Local radii along the branch slide over the slopes of a particle that
  // turns.
  const double radius =
      follows_surfaces || of.series ? of.circumscribed_radius : 0.;
  frame[k] = {mass(k) * of.gyration,
              follows_surfaces ? radius : std::max(radius, of.max_slope),
              of.principal};
}

Vec3 ParticleSystem::angular_momentum(std::size_t k) const
{
  if (!follows_surfaces)
    return inertia(k) * spin(k);
  const Quaternion to_world = orientation(k) * shape[k].principal;
  return to_world * (mass(k) * shape[k].gyration)
                        .cwiseProduct(to_world.conjugate() * spin(k));
}

Vec3 ParticleSystem::over_inertia(std::size_t k, const Vec3 &moment) const
{
  if (!follows_surfaces)
    return moment / inertia(k);
  const Quaternion to_world = orientation(k) * shape[k].principal;
  return to_world * (to_world.conjugate() * moment)
                        .cwiseQuotient(mass(k) * shape[k].gyration);
}

double ParticleSystem::kinetic_energy(std::size_t k) const
{
  return 0.5 * mass(k) * velocity(k).squaredNorm() +
         0.5 * spin(k).dot(angular_momentum(k));
}

double ParticleSystem::smallest_moment(std::size_t k) const
{
  return follows_surfaces ? mass(k) * shape[k].gyration.minCoeff() : inertia(k);
}

void ParticleSystem::reorder(const std::vector<std::int32_t> &order)
{
  visit(*this, [&order](auto &column) { reorder_column(column, order); });
  reorder_column(shape, order);
  if (!frame.empty())
    reorder_column(frame, order);
}

double ParticleSystem::smallest_mass() const
{
  return std::min_element(state.begin(), state.end(), is_lighter)->mass;
}

double ParticleSystem::smallest_radius() const
{
  return std::min_element(state.begin(), state.end(), is_smaller)->radius;
}

double ParticleSystem::largest_radius() const
{
  return std::max_element(state.begin(), state.end(), is_smaller)->radius;
}
} // namespace dem
