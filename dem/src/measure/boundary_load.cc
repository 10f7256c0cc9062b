#include <dem/engine_boundaries.h>
#include <dem/measure/boundary_load.h>
#include <dem/measure/network.h>

namespace dem
{
namespace
{
/// Of the contacts k of a batch for which is_on(k).
template <class IsOn>
WallLoad sum_of(const Engine &engine, const ContactBatch &batch,
                const Vec3 &about, const IsOn &is_on)
{
  WallLoad sum;
  for (std::size_t k = 0; k < batch.size(); ++k)
  {
    const Vec3 &force = batch.load[k].force;
    if (!is_on(k) || force.isZero(0.))
      continue;
    sum.force -= force;
    sum.moment -= (wall_contact_point(engine, batch, k) - about).cross(force);
  }
  return sum;
}
} // namespace

WallLoad load_on_plane(const Engine &engine, std::size_t plane,
                       const Vec3 &about)
{
  const ContactBatch &batch = on_planes(engine);
  WallLoad sum = sum_of(engine, batch, about,
                        [&](std::size_t k) {
                          return static_cast<std::size_t>(batch.b[k]) == plane;
                        });
  sum.force = planes(engine)[plane].force; // exact
  return sum;
}

WallLoad load_on_drum(const Engine &engine, const Vec3 &about)
{
  return sum_of(engine, on_drum(engine), about,
                [](std::size_t) { return true; });
}

} // namespace dem
