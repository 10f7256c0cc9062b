#include "specimen/mesh_walls.h"

#include "case/digits.h"
#include "case/file.h"
#include "case/parameter.h"
#include "errors.h"
#include "specimen/motion_table.h"

#include <dem/boundary/wall_clearance.h>
#include <dem/engine_boundaries.h>
#include <dem/io/mesh_reader.h>
#include <dem/measure/totals.h>
#include <fem/triangle_file.h>

#include <Eigen/Geometry>

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <utility>

namespace spall
{
namespace
{
/// Meshes that are wider have another unit than the case says [m].
constexpr double widest_wall = 100.;

[[noreturn]] void refuse_wall(const Case &c, const WallSection &wall,
                              const std::string &key, const std::string &value,
                              const std::string &what)
{
  throw InputError(c.file + ": " + wall.section() + "/" + key + " = " + value +
                   ": " + what);
}

dem::FacetSurface surface_of(const Case &c, const WallSection &wall,
                             const dem::Vec3 &origin)
{
  const std::string path = find_path(c, wall.section(), "mesh", wall.mesh);
  try
  {
    dem::TriangleMesh mesh = read_wall_mesh(path, wall.scale);
    for (dem::Vec3 &point : mesh.points)
      point += wall.position + origin;
    return dem::wall_surface(mesh, wall.particles);
  }
  catch (const std::invalid_argument &error)
  {
    refuse_wall(c, wall, "mesh", wall.mesh, error.what());
  }
}

dem::WallMotion motion_of(const Case &c, const WallSection &wall,
                          const dem::Vec3 &acceleration,
                          const dem::Vec3 &origin)
{
  dem::WallMotion motion;
  motion.start = wall.start;
  motion.velocity = wall.velocity;
  motion.amplitude = wall.amplitude;
  motion.frequency = wall.frequency;
  if (!wall.table.empty())
  {
    const MotionTable table =
        read_motion_table(find_path(c, wall.section(), "table", wall.table));
    motion.table_time = table.time;
    motion.table_shift = table.shift;
  }
  motion.axis = wall.axis.normalized();
  motion.centre = wall.centre + origin;
  motion.spin = wall.rotation_rate;
  motion.free = free_axes(wall.free);
  motion.mass = wall.mass;
  motion.force = wall.force + wall.mass * acceleration;
  motion.force_amplitude = wall.force_amplitude;
  motion.largest_speed = wall.largest_speed;
  motion.inertia = wall.inertia;
  motion.torque = wall.torque;
  return motion;
}
} // namespace

dem::TriangleMesh read_wall_mesh(const std::string &path, double scale)
{
  dem::TriangleMesh mesh;
  if (std::filesystem::path(path).extension() != ".msh")
    mesh = dem::read_mesh(path);
  else
  {
    fem::Triangles file = fem::read_triangles(path);
    mesh = {std::move(file.nodes), std::move(file.corners)};
  }
  Eigen::AlignedBox3d around;
  for (dem::Vec3 &point : mesh.points)
    around.extend(point *= scale);
  if (const double width = around.isEmpty() ? 0. : around.sizes().maxCoeff();
      width > widest_wall)
    throw std::invalid_argument(
        "is " + in_four_digits(width) + " m wide: must be at most " +
        number_text(widest_wall) + " m; a mesh in mm has scale = 0.001");
  return mesh;
}

void add_mesh_walls(dem::Engine &engine, const Case &parameters,
                    const dem::Vec3 &origin)
{
  for (const WallSection &wall : parameters.walls)
    try
    {
      dem::add_mesh_wall(
          engine, wall.name, wall.material,
          surface_of(parameters, wall, origin),
          motion_of(parameters, wall, engine.parameters().gravity, origin));
    }
    catch (const std::invalid_argument &error)
    {
      refuse_wall(parameters, wall, "mesh", wall.mesh, error.what());
    }
}

std::function<bool(const dem::Vec3 &, double)>
clear_of_walls(const Case &parameters, const dem::Vec3 &origin)
{
  if (parameters.walls.empty())
    return {};
  const auto walls = std::make_shared<dem::WallClearance>();
  for (const WallSection &wall : parameters.walls)
    walls->add(
        dem::MeshWall(wall.name, 0, wall.material,
                      surface_of(parameters, wall, origin),
                      motion_of(parameters, wall, dem::Vec3::Zero(), origin))
            .surface);
  return [walls](const dem::Vec3 &centre, double radius)
  { return walls->is_clear(centre, radius); };
}

dem::StepLimit limit_on_walls(const Case &parameters,
                              const dem::EngineParameters &engine,
                              const dem::ParticleSystem &particles,
                              const dem::StepLimit &limit)
{
  dem::StepLimit shortest = limit;
  dem::EngineParameters on = engine;
  for (const WallSection &wall : parameters.walls)
  {
    on.surface = wall.material;
    const dem::StepLimit its = dem::critical_step(
        on, particles, "the wall (" + wall.section() + "/normal_stiffness)");
    if (its.step < shortest.step)
      shortest = its;
  }
  return shortest;
}

std::vector<std::pair<std::string, double>>
wall_quantities(const dem::Engine &engine)
{
  std::vector<std::pair<std::string, double>> all;
  for (const dem::MeshWall &wall : dem::mesh_walls(engine))
  {
    const auto add = [&](const std::string &what, double value)
    { all.emplace_back(wall.label + "_" + what, value); };
    const auto add_vector = [&](const std::string &what,
                                const std::string &unit, const dem::Vec3 &v)
    {
      add(what + "_x_" + unit, v.x());
      add(what + "_y_" + unit, v.y());
      add(what + "_z_" + unit, v.z());
    };
    const dem::WallLoad load = wall.load();
    add_vector("force", "N", load.force);
    add_vector("moment", "Nm", load.moment);
    add_vector("displacement", "m", wall.pose().shift);
    add("rotation_rad", wall.pose().angle);
    add("friction_J", dem::total_friction(engine, wall) + 0.); // no -0
  }
  return all;
}
} // namespace spall
