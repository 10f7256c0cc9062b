// A container from a mesh file.
#include "specimen/container_mesh.h"

#include "case/file.h"
#include "case/parameter.h"
#include "errors.h"
#include "specimen/mesh_walls.h"

#include <dem/engine_boundaries.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace spall
{
namespace
{
/// Clouds of this many times the height of one layer's cloud find room [-].
constexpr double room_for_cloud = 3.;

/// That a layer falls through [m].
double collar_height(const dem::Container &container,
                     const ContainerFilling &filling)
{
  const double solid =
      filling.solid_share * container.volume_below(filling.height);
  const double cloud = solid / (filling.layers * filling.cloud_fraction *
                                container.section(container.rim()));
  return std::max(container.rim(), room_for_cloud * cloud);
}

/// Of the box around the container, and of the circle that has the area of its
/// rim; the smallest [m].
double width_of(const dem::Container &container)
{
  const double round =
      2. * std::sqrt(container.section(container.rim()) / std::numbers::pi);
  return std::min(round,
                  (container.upper() - container.lower()).head<2>().minCoeff());
}
} // namespace

dem::Room container_room(const Case &c, dem::ContainerBottom bottom,
                         const ContainerFilling &filling)
{
  const ContainerParameters &box = c.container;
  const std::string path = find_path(c, "Container", "mesh", box.mesh);
  try
  {
    const dem::TriangleMesh mesh = read_wall_mesh(path, box.scale);
    auto container = std::make_shared<dem::Container>(
        dem::wall_surface(mesh, dem::WallSide::inside), bottom);
    container->set_collar(collar_height(*container, filling));
    const dem::Vec3 width = container->upper() - container->lower();
    dem::Vec3 floor = container->lower() + 0.5 * width;
    floor.z() = 0.;
    return {floor, width.x(), width.y(), false, std::move(container)};
  }
  catch (const std::invalid_argument &error)
  {
    throw InputError(c.file + ": Container/mesh = " + box.mesh + ": " +
                     error.what());
  }
}

void add_container(const Case &parameters, const dem::Room &room,
                   dem::Engine &engine)
{
  dem::add_mesh_wall(engine, container_name, parameters.wall,
                     room.container->wall(), {});
}

void check_container(const Case &c, const SourceLocation &location,
                     const dem::Container &container,
                     const FilledHeight &height)
{
  // The rim may be a rounded number of the file.
  if (height.value > (1. + 1e-6) * container.rim())
    refuse(location, {height.section, height.key, number_text(height.value),
                      "must be at most the height of Container/mesh, " +
                          number_text(container.rim()) + " m"});
  if (dem::law_of(c.wall).entry().attracts)
    refuse(location, {"Wall", "law", c.wall.law,
                      "must be a law without attraction with Container/mesh: "
                      "a mesh does not attract across gaps"});
}

void check_container_width(const Case &c, const SourceLocation &location,
                           const dem::Container &container,
                           const Gradation &gradation,
                           std::pair<double, const char *> times)
{
  const double width = width_of(container);
  if (width < times.first * gradation.diameter.back())
    refuse(location,
           {"Container", "mesh", c.container.mesh,
            "is " + number_text(width) + " m wide: must be at least " +
                times.second + " the largest particle of the gradation, " +
                largest_text(gradation)});
}

void check_inside(const Case &c, const PlacedParticles &particles,
                  const dem::Container &container)
{
  for (std::size_t k = 0; k < particles.size(); ++k)
    if (!container.holds(particles.placement[k].position, 0.))
      throw InputError(c.file + ": " + particles.name[k] +
                       ": its centre must be inside of Container/mesh");
}
} // namespace spall
