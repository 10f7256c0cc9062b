#include "single_particle/single_particle.h"

#include "case/file.h"
#include "shape/loaded.h"

#include <dem/binary.h>
#include <dem/engine_boundaries.h>
#include <dem/neighbor/contact_points.h>
#include <dem/random.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>

namespace spall
{
namespace
{
constexpr std::size_t lower_platen = 0, upper_platen = 1;

/// The shape of the case, cut at its order; none: a sphere.
ShapeLibrary load_shape(const Case &parameters)
{
  const SingleParticleParameters &p = parameters.single_particle;
  if (p.shape.empty())
    return {};
  return {load_with_warnings(
      read_shape(find_path(parameters, "Particle", "shape", p.shape)),
      p.order)};
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

std::unique_ptr<dem::Engine> make_scene(const Case &parameters,
                                        const ShapeLibrary &shapes)
{
  dem::EngineParameters settings;
  settings.particle = parameters.particle;
  settings.wall = settings.surface = parameters.wall;
  settings.geometry = parameters.contact;
  settings.friction_limit = parameters.friction_limit;
  settings.breakage = parameters.breakage;
  settings.local_damping = parameters.time.local_damping;
  settings.geometry.usual_skin = 0.1 * parameters.single_particle.diameter;
  auto engine = std::make_unique<dem::Engine>(settings);
  const dem::ParticleShape particle = make_particle(parameters, shapes);
  const dem::Quaternion turned = orientation(parameters.single_particle);
  engine->add_particle(particle, dem::Vec3::Zero(), turned);
  const dem::Vec3 up = turned.conjugate() * dem::Vec3::UnitZ();
  const dem::ContactGeometry geometry = parameters.contact.wall_geometry;
  const dem::Vec3 z = dem::Vec3::UnitZ();
  dem::add_plane(*engine, -reach(particle, geometry, -up) * z, z);
  dem::add_plane(*engine, reach(particle, geometry, up) * z, -z);
  dem::planes(*engine)[upper_platen].velocity = -parameters.press.speed * z;
  return engine;
}
} // namespace

SingleParticle::SingleParticle(const Case &c) : SingleParticle(c, load_shape(c))
{
}

SingleParticle::SingleParticle(const Case &c, const ShapeLibrary &library)
    : Test(c, library, make_scene(c, library))
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

double SingleParticle::force() const
{
  return dem::planes(engine())[upper_platen].force.z();
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
          {"lower_force_N", -dem::planes(engine())[lower_platen].force.z()}};
}

void SingleParticle::summarise(nlohmann::ordered_json &summary) const
{
  Test::summarise(summary);
  summary["peak_force_N"] = peak_force;
  summary["final_force_N"] = force();
  summary["displacement_m"] = progress_at(engine().time());
}

void SingleParticle::save(std::ostream &out) const
{
  Test::save(out);
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
