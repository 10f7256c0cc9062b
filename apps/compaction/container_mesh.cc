// A container from a mesh file.
#include "compaction/container_mesh.h"

#include "case/checks.h"
#include "case/file.h"
#include "case/parameter.h"
#include "errors.h"
#include "specimen/mesh_walls.h"

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
double collar_height(const Case &c, const dem::Container &container)
{
  const FillingParameters &f = c.filling;
  const double solid = f.density / c.particle.density *
                       container.volume_below(c.container.height);
  const double cloud = solid / (f.layers * f.solid_fraction *
                                container.section(container.rim()));
  return std::max(container.rim(), room_for_cloud * cloud);
}
} // namespace

std::shared_ptr<const dem::Container> container_of_mesh(const Case &c)
{
  const ContainerParameters &box = c.container;
  if (!box.has_mesh())
    return nullptr;
  const std::string path = find_path(c, "Container", "mesh", box.mesh);
  try
  {
    dem::TriangleMesh mesh = read_wall_mesh(path);
    for (dem::Vec3 &point : mesh.points)
      point *= box.scale;
    auto container = std::make_shared<dem::Container>(
        dem::wall_surface(mesh, dem::WallSide::inside));
    container->set_collar(collar_height(c, *container));
    return container;
  }
  catch (const std::invalid_argument &error)
  {
    throw InputError(c.file + ": Container/mesh = " + box.mesh + ": " +
                     error.what());
  }
}

namespace
{
/// Of the box around the container, and of the circle that has the area of its
/// rim; the smallest [m].
double width_of(const dem::Container &container)
{
  const double round =
      2. * std::sqrt(container.section(container.rim()) / std::numbers::pi);
  return std::min(round,
                  (container.upper() - container.lower()).head<2>().minCoeff());
}

void check_size(const Case &c, const SourceLocation &location,
                const dem::Container &container)
{
  const ContainerParameters &box = c.container;
  // The rim may be a rounded number of the file.
  if (box.height > (1. + 1e-6) * container.rim())
    refuse(location, {"Container", "height", number_text(box.height),
                      "must be at most the height of Container/mesh, " +
                          number_text(container.rim()) + " m"});
  if (!c.filling.particles.empty())
    return; // their sizes are those of the file
  const Gradation curve =
      check_gradation(c, location, "Filling", c.filling.gradation);
  const double width = width_of(container);
  if (width < 2. * curve.diameter.back())
    refuse(location,
           {"Container", "mesh", box.mesh,
            "is " + number_text(width) +
                " m wide: must be at least twice the largest particle of the "
                "gradation, " +
                largest_text(curve)});
}
} // namespace

void check_container_mesh(const Case &c, const SourceLocation &location)
{
  const ContainerParameters &box = c.container;
  if (!box.has_mesh())
    return;
  if (box.is_flexible())
    refuse(location, {"Container", "form", "flexible",
                      "must be rigid with Container/mesh"});
  if (c.plate.form != PlateKind::rigid)
    refuse(location,
           {"Plate", "form",
            c.plate.form == PlateKind::tilting ? "tilting" : "elastic",
            "must be rigid with Container/mesh: other plates are discs as "
            "wide as the cylinder"});
  if (dem::law_of(c.wall).entry().attracts)
    refuse(location, {"Wall", "law", c.wall.law,
                      "must be a law without attraction with Container/mesh: "
                      "a mesh does not attract across gaps"});
  check_size(c, location, *container_of_mesh(c));
}
} // namespace spall
