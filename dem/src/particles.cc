#include <dem/particles.h>

namespace dem
{
void Particles::add(const Body &stone, const Vec3 &at, const Quaternion &turned,
                    double density)
{
  id.push_back(static_cast<std::int64_t>(id.size()));
  position.push_back(at);
  velocity.push_back(Vec3::Zero());
  spin.push_back(Vec3::Zero());
  orientation.push_back(turned);
  rotation.push_back(turned.toRotationMatrix());
  body.push_back(stone);
  radius.push_back(0.);
  mass.push_back(0.);
  inertia.push_back(0.);
  update_mass(size() - 1, density);
  initial_mass.push_back(mass.back());
  is_breakable.push_back(0);
  force.push_back(Vec3::Zero());
  moment.push_back(Vec3::Zero());
}

void Particles::update_mass(std::size_t k, double density)
{
  radius[k] = mean_radius(body[k]);
  mass[k] = density * body[k].volume;
  inertia[k] = 0.4 * mass[k] * radius[k] * radius[k];
}
} // namespace dem
