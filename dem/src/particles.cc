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
}

void Particles::update_mass(std::size_t k, double density)
{
  StoneState &stone = state[k];
  stone.radius = mean_radius(body[k]);
  stone.mass = density * body[k].volume;
  stone.inertia = 0.4 * stone.mass * stone.radius * stone.radius;
}

void Particles::reorder(const std::vector<std::int32_t> &order)
{
  visit(*this, [&order](auto &column) { reorder_column(column, order); });
  reorder_column(body, order);
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
