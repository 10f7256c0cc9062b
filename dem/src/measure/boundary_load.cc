#include <dem/engine_boundaries.h>
#include <dem/measure/boundary_load.h>
#include <dem/measure/network.h>
#include <dem/measure/totals.h>

#include <array>

namespace dem
{
namespace
{
/// Of the contacts k of a batch for which is_on(k), of all ranks.
template <class IsOn>
WallLoad sum_of(const Engine &engine, const ContactBatch &batch,
                const Vec3 &about, const IsOn &is_on)
{
  std::array<ExactSum, 6> sums; // force [N] and moment [N m]
  for (std::size_t k = 0; k < batch.size(); ++k)
  {
    const Vec3 &force = batch.load[k].force;
    if (!is_on(k) || force.isZero(0.))
      continue;
    const Vec3 moment =
        (wall_contact_point(engine, batch, k) - about).cross(force);
    for (std::size_t d = 0; d < 3; ++d)
    {
      sums[d].add(-force[static_cast<Eigen::Index>(d)]);
      sums[3 + d].add(-moment[static_cast<Eigen::Index>(d)]);
    }
  }
  sum_over_ranks(engine, sums);
  return {{sums[0].value(), sums[1].value(), sums[2].value()},
          {sums[3].value(), sums[4].value(), sums[5].value()}};
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
