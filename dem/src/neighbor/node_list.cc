#include "node_list.h"

#include <dem/instruction_set.h>

#include <cmath>

namespace dem
{
namespace
{
static_assert(RadiusMap::nodes.n_polar == kernel::map_rings &&
              RadiusMap::nodes.n_azimuth == kernel::map_columns);

const kernel::MapAngles &angles()
{
  static const kernel::MapAngles table = []
  {
    constexpr DirectionGrid grid = RadiusMap::nodes;
    kernel::MapAngles made;
    for (int i = 0; i < grid.n_polar; ++i)
    {
      const Vec3 direction = grid.direction(i, 0);
      made.sine[i] = static_cast<float>(direction.x());
      made.cosine[i] = static_cast<float>(direction.z());
    }
    for (int k = 0; k < grid.n_azimuth; ++k)
    {
      const double azimuth = 2. * std::numbers::pi * k / grid.n_azimuth;
      made.column_sine[k] = static_cast<float>(std::sin(azimuth));
      made.column_cosine[k] = static_cast<float>(std::cos(azimuth));
    }
    return made;
  }();
  return table;
}

kernel::MapView view_of(const MappedParticle &particle)
{
  return {particle.map.radii(), static_cast<float>(particle.body.scale)};
}
} // namespace

const kernel::MapLoops &kernel::map_loops()
{
  const InstructionSet set = instruction_set();
  return set == InstructionSet::avx512 ? avx512::map_loops
         : set == InstructionSet::avx2 ? avx2::map_loops
                                       : baseline::map_loops;
}

NodeList::NodeList(const MappedParticle &particle, const Vec3 &up,
                   double lowest)
{
  const Eigen::Vector3f along = up.cast<float>();
  n = kernel::map_loops().nodes_above(angles(), view_of(particle), along.data(),
                                      static_cast<float>(lowest), nodes.data(),
                                      points());
}

Vec3 NodeList::position(int k) const
{
  const auto at = static_cast<std::size_t>(k);
  return {x[at], y[at], z[at]};
}

void find_gaps(const MappedParticle &particle, const RelativePose &pose,
               double range, const kernel::PointRows &points, int n, float *gap)
{
  kernel::MapField field;
  field.map = view_of(particle);
  for (int c = 0; c < 3; ++c)
  {
    field.centre[c] = static_cast<float>(pose.position[c]);
    for (int d = 0; d < 3; ++d)
      field.rotation[3 * c + d] = static_cast<float>(pose.rotation(c, d));
  }
  field.reach = static_cast<float>(particle.body.circumscribed_radius + range);
  kernel::map_loops().gaps(field, points, n, gap);
}
} // namespace dem
