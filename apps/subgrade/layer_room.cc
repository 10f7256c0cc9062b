#include "subgrade/layer_room.h"

#include "specimen/container_mesh.h"

#include <dem/engine_boundaries.h>

namespace spall
{
dem::Room layer_room(const Case &c)
{
  const LayerParameters &l = c.subgrade.layer;
  if (!c.container.has_mesh())
    return {dem::Vec3::Zero(), l.length, l.width, false};
  return container_room(
      c, dem::ContainerBottom::open,
      {l.thickness, l.solid_fraction, l.layers, l.initial_solid_fraction});
}

dem::Polygon foot_of(const dem::Room &room)
{
  if (room.container)
    return room.container->foot();
  const double x = 0.5 * room.width_x, y = 0.5 * room.width_y;
  return {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
}

void add_sides(const Case &parameters, const dem::Room &room,
               dem::Engine &engine)
{
  if (room.container)
    return add_container(parameters, room, engine);
  const dem::Vec3 half(0.5 * room.width_x, 0.5 * room.width_y, 0.);
  for (int d = 0; d < 2; ++d)
    for (const double sign : {-1., 1.})
    {
      dem::Vec3 inward = dem::Vec3::Zero();
      inward[d] = -sign;
      dem::add_plane(engine, sign * half, inward);
    }
}
} // namespace spall
