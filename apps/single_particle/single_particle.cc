#include "single_particle/single_particle.h"

#include "case/file.h"
#include "errors.h"
#include "shape/loaded.h"
#include "specimen/mesh_walls.h"

#include <dem/binary.h>
#include <dem/engine_boundaries.h>
#include <dem/neighbor/contact_points.h>
#include <dem/random.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

namespace spall
{
namespace
{
/// Walls of these names take the place of the platens.
constexpr const char *lower_name = "lower", *upper_name = "upper";

bool has_wall(const Case &c, const std::string &name)
{
  return std::ranges::find(c.walls, name, &WallSection::name) != c.walls.end();
}

/// The shape of the case, cut at its order; none: a sphere.
ShapeLibrary load_shape(const Case &parameters)
{
  const SingleParticleParameters &p = parameters.single_particle;
  if (p.shape.empty())
    return {};
  const ShapeFile file =
      read_shape(find_path(parameters, "Particle", "shape", p.shape));
  ShapeLibrary library;
  library.add(load_with_warnings(file, p.order), file);
  return library;
}

dem::ParticleShape make_particle(const Case &parameters,
                                 const ShapeLibrary &shapes)
{
  const double radius = 0.5 * parameters.single_particle.diameter;
  return shapes.empty()
             ? dem::make_sphere(radius)
             : dem::make_shape(
                   shapes[0], radius,
                   dem::sphere_rule(parameters.breakage.quadrature_rings));
}

dem::Quaternion orientation(const SingleParticleParameters &p)
{
  if (p.seed == 0)
    return dem::Quaternion::FromTwoVectors(
        dem::Vec3(p.axis_x, p.axis_y, p.axis_z), dem::Vec3::UnitZ());
  dem::Random random(static_cast<std::uint64_t>(p.seed));
  return random.rotation();
}

/// How far the particle reaches along a body direction, as its contacts see it.
double reach(const dem::ParticleShape &body, dem::ContactGeometry geometry,
             const dem::Vec3 &direction)
{
  if (!body.series || geometry == dem::ContactGeometry::sphere)
    return dem::mean_radius(body);
  if (geometry == dem::ContactGeometry::radial)
    return body.scale * dem::radius(*body.series, direction);
  const dem::RadiusMap map(body.series);
  // Its farthest point is no nearer than the inscribed sphere.
  return dem::find_supports({body, map}, direction, {body.inscribed_radius, 0.})
      .at(0)
      .overlap;
}

dem::EngineParameters engine_settings(const Case &parameters)
{
  dem::EngineParameters settings;
  settings.particle = parameters.particle;
  settings.wall = settings.surface = parameters.wall;
  settings.geometry = parameters.contact;
  settings.friction_limit = parameters.friction_limit;
  settings.breakage = parameters.breakage;
  settings.local_damping = parameters.time.local_damping;
  settings.geometry.usual_skin = 0.1 * parameters.single_particle.diameter;
  return settings;
}

/// Whether the particle touches a wall that is moved by `shift` along z [m].
bool touches(const Case &parameters, const dem::ParticleShape &particle,
             WallSection wall, double shift)
{
  wall.position.z() += shift;
  Case alone = parameters;
  alone.walls = {std::move(wall)};
  dem::EngineParameters settings = engine_settings(parameters);
  settings.geometry.overlap.stop = std::numeric_limits<double>::max();
  dem::Engine engine(settings);
  engine.add_particle(particle, dem::Vec3::Zero(),
                      orientation(parameters.single_particle));
  add_mesh_walls(engine, alone);
  engine.set_breaking(false);
  engine.evaluate(1e-12);
  const dem::ContactBatch &batch = dem::mesh_walls(engine)[0].get().batch;
  for (std::size_t k = 0; k < batch.size(); ++k)
    if (batch.overlap[k] > 0.)
      return true;
  return false;
}

/// A wall that is a platen, moved along z to where it comes to touch the
/// particle: from below (side -1) or from above (+1).
void bring_to_touch(const Case &parameters, const dem::ParticleShape &particle,
                    double side, WallSection &wall)
{
  Case alone = parameters;
  alone.walls = {wall};
  dem::Engine empty(engine_settings(parameters));
  add_mesh_walls(empty, alone);
  double near = -std::numeric_limits<double>::max(); // to the particle
  double far = -near;
  for (const dem::Vec3 &point :
       dem::mesh_walls(empty)[0].get().surface.position)
  {
    near = std::max(near, -side * point.z());
    far = std::min(far, -side * point.z());
  }
  const double reach = 1.001 * particle.circumscribed_radius;
  // `apart` is how far out the wall is moved; it goes through the particle.
  double apart = reach + near;
  const double step = 0.02 * reach, last = far - reach;
  while (!touches(parameters, particle, wall, side * (apart - step)))
    if ((apart -= step) < last)
      throw InputError(parameters.file + ": " + wall.section() +
                       "/mesh = " + wall.mesh +
                       ": does not meet the particle, which is at the origin, "
                       "along z");
  double touching = apart - step;
  while (apart - touching > 1e-12 * reach)
  {
    const double middle = 0.5 * (apart + touching);
    (touches(parameters, particle, wall, side * middle) ? touching : apart) =
        middle;
  }
  wall.position.z() += side * apart;
}

/// With platens that are walls where they touch the particle, the upper one
/// with the speed of the press.
Case with_platens(const Case &parameters, const dem::ParticleShape &particle)
{
  Case moved = parameters;
  for (WallSection &wall : moved.walls)
    if (wall.name == upper_name || wall.name == lower_name)
    {
      const bool is_upper = wall.name == upper_name;
      bring_to_touch(parameters, particle, is_upper ? 1. : -1., wall);
      if (is_upper)
        wall.velocity = -parameters.press.speed * dem::Vec3::UnitZ();
    }
  return moved;
}

/// Between flat platens that touch it, as its contacts see it [m].
double particle_height(const Case &parameters, const ShapeLibrary &shapes)
{
  const dem::ParticleShape particle = make_particle(parameters, shapes);
  const dem::Vec3 up =
      orientation(parameters.single_particle).conjugate() * dem::Vec3::UnitZ();
  const dem::ContactGeometry geometry = parameters.contact.wall_geometry;
  return reach(particle, geometry, up) + reach(particle, geometry, -up);
}

std::unique_ptr<dem::Engine> make_scene(const Case &parameters,
                                        const ShapeLibrary &shapes)
{
  auto engine = std::make_unique<dem::Engine>(engine_settings(parameters));
  const dem::ParticleShape particle = make_particle(parameters, shapes);
  const dem::Quaternion turned = orientation(parameters.single_particle);
  engine->add_particle(particle, dem::Vec3::Zero(), turned);
  const dem::Vec3 up = turned.conjugate() * dem::Vec3::UnitZ();
  const dem::ContactGeometry geometry = parameters.contact.wall_geometry;
  const dem::Vec3 z = dem::Vec3::UnitZ();
  if (!has_wall(parameters, lower_name))
    dem::add_plane(*engine, -reach(particle, geometry, -up) * z, z);
  if (!has_wall(parameters, upper_name))
  {
    const std::size_t plane =
        dem::add_plane(*engine, reach(particle, geometry, up) * z, -z);
    dem::planes(*engine)[plane].velocity = -parameters.press.speed * z;
  }
  add_mesh_walls(*engine, with_platens(parameters, particle));
  return engine;
}
} // namespace

SingleParticle::SingleParticle(const Case &c) : SingleParticle(c, load_shape(c))
{
}

SingleParticle::SingleParticle(const Case &c, const ShapeLibrary &library)
    : Test(c, library, make_scene(c, library)),
      height(particle_height(c, library))
{
}

void SingleParticle::move(double time_step)
{
  displacement_before = progress_at(engine().time());
  events_before = events_now;
  engine().advance_deferred(time_step);
  events_now = engine().n_events();
  peak_force = std::max(peak_force, force());
}

/// Of the particle on a platen, along z [N].
double SingleParticle::force_on(const std::string &name) const
{
  for (const dem::MeshWall &wall : dem::mesh_walls(engine()))
    if (wall.label == name)
      return wall.load().force.z();
  return dem::planes(engine())[plane_of(name)].force.z();
}

double SingleParticle::force() const
{
  return force_on(upper_name);
}

/// Number of a platen among the planes.
std::size_t SingleParticle::plane_of(const std::string &name) const
{
  return name == upper_name && !has_wall(parameters, lower_name) ? 1 : 0;
}

std::vector<NamedBoundary> SingleParticle::named_boundaries() const
{
  std::vector<NamedBoundary> all;
  for (const char *name : {lower_name, upper_name})
    if (!has_wall(parameters, name))
      all.push_back({name, BoundaryKind::plane, plane_of(name)});
  return all;
}

double SingleParticle::progress_at(double time) const
{
  return parameters.press.speed * time;
}

double SingleParticle::share_done() const
{
  return progress_at(engine().time()) / parameters.press.displacement;
}

double SingleParticle::duration() const
{
  return parameters.press.displacement / parameters.press.speed;
}

std::string SingleParticle::phase() const
{
  char text[40];
  std::snprintf(text, sizeof text, "%.3f mm",
                1e3 * progress_at(engine().time()));
  return text;
}

std::string SingleParticle::outcome() const
{
  char text[160];
  std::snprintf(text, sizeof text,
                "force %.5g N, largest force %.5g N, LAA %.5f %%, %lld events",
                force(), peak_force, abrasion_percent(),
                static_cast<long long>(engine().n_events()));
  return text;
}

Due SingleParticle::due() const
{
  const double rows = parameters.press.rows;
  const auto row_of = [&](double displacement)
  {
    return std::floor(displacement / parameters.press.displacement * rows +
                      1e-9);
  };
  Due due;
  due.row = events_now != events_before ||
            row_of(displacement_before) != row_of(progress_at(engine().time()));
  return due;
}

std::vector<Quantity> SingleParticle::measured() const
{
  return {{"displacement_m", progress_at(engine().time())},
          {"force_N", force(), true},
          {"lower_force_N", -force_on(lower_name)}};
}

void SingleParticle::summarise(nlohmann::ordered_json &summary) const
{
  Test::summarise(summary);
  summary["peak_force_N"] = peak_force;
  summary["final_force_N"] = force();
  // Nominal stress F / d^2: J. C. Jaeger, Int. J. Rock Mech. Min. Sci. 4 (1967)
  // 219-227, as G. R. McDowell and M. D. Bolton, Geotechnique 48 (1998), use
  // it.
  summary["particle_height_m"] = height;
  const double area = height * height;
  summary["peak_nominal_stress_Pa"] = peak_force / area;
  if (const auto first = summary.find("first_event_force_N");
      first != summary.end())
    summary["first_event_nominal_stress_Pa"] = first->get<double>() / area;
  summary["displacement_m"] = progress_at(engine().time());
}

void SingleParticle::save(std::ostream &out, dem::StateExtent extent) const
{
  Test::save(out, extent);
  dem::write_value(out, peak_force);
  dem::write_value(out, displacement_before);
  dem::write_value(out, events_before);
  dem::write_value(out, events_now);
}

void SingleParticle::restore(std::istream &in)
{
  Test::restore(in);
  dem::read_value(in, peak_force);
  dem::read_value(in, displacement_before);
  dem::read_value(in, events_before);
  dem::read_value(in, events_now);
}
} // namespace spall
