#include <dem/particles.h>

#include <algorithm>

namespace dem
{
namespace
{
bool is_lighter(const StoneState &a, const StoneState &b)
{
  return a.mass < b.mass;
}

bool is_smaller(const StoneState &a, const StoneState &b)
{
  return a.radius < b.radius;
}
} // namespace

void Particles::add(const Body &stone, const Vec3 &at, const Quaternion &turned,
                    double density)
{
  id.push_back(static_cast<std::int64_t>(id.size()));
  body.push_back(stone);
  has_shapes |= stone.series != nullptr;
  StoneState &fresh = state.emplace_back();
  fresh.position = at;
  fresh.orientation = turned;
  update_mass(size() - 1, density);
  initial_mass.push_back(fresh.mass);
  is_breakable.push_back(0);
  material.push_back(0);
  load.emplace_back();
  travelled.push_back(0.);
  if (has_shapes && frame.size() + 1 < size())
    renew_frames();
  else if (has_shapes)
  {
    frame.emplace_back();
    set_frame(size() - 1);
  }
}

void Particles::update_mass(std::size_t k, double density)
{
  StoneState &stone = state[k];
  stone.radius = mean_radius(body[k]);
  stone.mass = density * body[k].volume;
  stone.inertia = 0.4 * stone.mass * stone.radius * stone.radius;
  if (k < frame.size())
    set_frame(k);
}

void Particles::renew_frames()
{
  frame.resize(has_shapes ? size() : 0);
  for (std::size_t k = 0; k < frame.size(); ++k)
    set_frame(k);
}

void Particles::set_frame(std::size_t k)
{
  const Body &of = body[k];
  // Local radii along the branch slide over the slopes of a stone that turns.
  const double radius =
      follows_surfaces || of.series ? of.circumscribed_radius : 0.;
  frame[k] = {mass(k) * of.gyration,
              follows_surfaces ? radius : std::max(radius, of.max_slope),
              of.principal};
}

Vec3 Particles::angular_momentum(std::size_t k) const
{
  if (!follows_surfaces)
    return inertia(k) * spin(k);
  const Quaternion to_world = orientation(k) * body[k].principal;
  return to_world * (mass(k) * body[k].gyration)
                        .cwiseProduct(to_world.conjugate() * spin(k));
}

Vec3 Particles::over_inertia(std::size_t k, const Vec3 &moment) const
{
  if (!follows_surfaces)
    return moment / inertia(k);
  const Quaternion to_world = orientation(k) * body[k].principal;
  return to_world * (to_world.conjugate() * moment)
                        .cwiseQuotient(mass(k) * body[k].gyration);
}

double Particles::kinetic_energy(std::size_t k) const
{
  return 0.5 * mass(k) * velocity(k).squaredNorm() +
         0.5 * spin(k).dot(angular_momentum(k));
}

double Particles::smallest_moment(std::size_t k) const
{
  return follows_surfaces ? mass(k) * body[k].gyration.minCoeff() : inertia(k);
}

void Particles::reorder(const std::vector<std::int32_t> &order)
{
  visit(*this, [&order](auto &column) { reorder_column(column, order); });
  reorder_column(body, order);
  if (!frame.empty())
    reorder_column(frame, order);
}

double Particles::smallest_mass() const
{
  return std::min_element(state.begin(), state.end(), is_lighter)->mass;
}

double Particles::smallest_radius() const
{
  return std::min_element(state.begin(), state.end(), is_smaller)->radius;
}

double Particles::largest_radius() const
{
  return std::max_element(state.begin(), state.end(), is_smaller)->radius;
}
} // namespace dem
