#include <dem/boundary/surface_contacts.h>

#include <utility>

namespace dem
{
SurfaceContacts::SurfaceContacts(std::string its_name, const WallMaterial &law,
                                 FacetSurface at_start)
    : name(std::move(its_name)), material(law), surface(std::move(at_start)),
      topology(surface), impulse(surface.position.size(), Vec3::Zero()),
      load_before(impulse)
{
}

Vec3 SurfaceContacts::point_of(std::size_t k) const
{
  return point_at(surface, candidates.contact_point[k]);
}

Mat3 SurfaceContacts::spread_of(std::size_t k) const
{
  Mat3 sum = Mat3::Zero();
  const FacetContactPoint &contact_point = candidates.contact_point[k];
  const Vec3 &force = batch.load[k].force, point = point_of(k);
  for_loads(surface, contact_point, force,
            [&](std::size_t vertex, const Vec3 &part)
            { sum += part * (surface.position[vertex] - point).transpose(); });
  return sum;
}

void SurfaceContacts::book_step(double time_step)
{
  load_surface(candidates, batch, surface);
  double power = 0.;
  for (std::size_t v = 0; v < surface.load.size(); ++v)
  {
    const Vec3 mean = 0.5 * (load_before[v] + surface.load[v]);
    power += mean.dot(surface.velocity[v]);
    impulse[v] += time_step * mean;
  }
  work -= power * time_step;
  load_before = surface.load;
}
} // namespace dem
