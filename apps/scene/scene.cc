#include "scene/scene.h"

#include "test/checkpoint.h"

#include <dem/binary.h>
#include <dem/engine_boundaries.h>
#include <dem/measure/assembly.h>
#include <dem/parallel/mpi_ranks.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace spall
{
namespace
{
dem::Vec3 centre_of_mass(const dem::Engine &engine)
{
  const dem::ParticleSystem &own = engine.particles();
  const auto [x, y, z, mass] = dem::sum_particles<4>(
      engine,
      [&own](std::size_t i)
      {
        const dem::Vec3 moment = own.mass(i) * own.position(i);
        return std::array{moment.x(), moment.y(), moment.z(), own.mass(i)};
      });
  return dem::Vec3(x, y, z) / mass;
}

double largest_speed(const dem::Engine &engine)
{
  const dem::ParticleSystem &own = engine.particles();
  return std::sqrt(dem::largest_of_particles(
      engine, 0.,
      [&own](std::size_t i) { return own.velocity(i).squaredNorm(); }));
}
} // namespace

Scene::Scene(const Case &c) : Scene(c, make_scene_particles(c)) {}

Scene::Scene(const Case &c, const PlacedParticles &particles)
    : Scene(c, particles, check_scene_as_placed(c, particles),
            build_scene(c, particles, dem::ranks_of_program()))
{
}

Scene::Scene(const Case &c, const PlacedParticles &particles,
             const SceneStart &as_placed, BuiltScene built)
    : Test(c, particles.shapes, std::move(built.engine), as_placed.limit,
           first_step(c, as_placed.limit)),
      own(parameters.own<SceneCase>()), start(as_placed),
      box(std::move(built.box))
{
}

EnergyBalance Scene::energy_balance() const
{
  EnergyBalance balance = Test::energy_balance();
  balance.external_work += start.kinetic + start.elastic;
  balance.residual += start.kinetic;
  // Springs that are stretched from the first step on were booked as injected.
  balance.non_conservative_work += start.elastic;
  return balance;
}

void Scene::move(double time_step)
{
  time_before = engine().time();
  if (!is_breaking && time_before >= own.scene.breakage_start)
  {
    is_breaking = 1;
    engine().set_breaking(parameters.breakage.is_active);
  }
  engine().advance_deferred(time_step);
}

double Scene::share_done() const
{
  return engine().time() / own.scene.duration;
}

std::string Scene::phase() const
{
  char text[40];
  std::snprintf(text, sizeof text, "%.4g s", engine().time());
  return text;
}

std::string Scene::outcome() const
{
  const dem::Engine &all = synchronized();
  const dem::Vec3 centre = centre_of_mass(all);
  char text[200];
  std::snprintf(text, sizeof text,
                "centre of mass %.4g %.4g %.4g m, largest speed %.3g m/s, "
                "kinetic energy %.3g J, %lld events",
                centre.x(), centre.y(), centre.z(), largest_speed(all),
                synchronized().energy().kinetic,
                static_cast<long long>(engine().n_events()));
  return text;
}

Due Scene::due() const
{
  const auto has_passed = [this](double interval)
  {
    return interval > 0. && std::floor(engine().time() / interval + 1e-9) !=
                                std::floor(time_before / interval + 1e-9);
  };
  const SceneParameters &s = own.scene;
  Due due;
  due.row = has_passed(s.duration / s.rows) || share_done() >= 1.;
  due.frame = has_passed(frame_interval());
  due.checkpoint = has_passed(s.checkpoint_every);
  return due;
}

double Scene::frame_interval() const
{
  return own.scene.frames > 0 ? own.scene.duration / own.scene.frames : 0.;
}

FrameParts Scene::frame_parts() const
{
  return {nullptr, !shape_library().empty()};
}

std::vector<Quantity> Scene::measured() const
{
  const dem::Engine &all = synchronized();
  const dem::ContactNetwork network = dem::contact_network(all);
  const dem::Vec3 centre = centre_of_mass(all);
  std::vector<Quantity> row = {
      {"centre_of_mass_x_m", centre.x()},
      {"centre_of_mass_y_m", centre.y()},
      {"centre_of_mass_z_m", centre.z(), true},
      {"largest_speed_m_per_s", largest_speed(all), true},
      {"n_contacts_1", static_cast<double>(network.n_contacts)},
      {"mean_contact_force_N", network.mean_force}};
  return row;
}

std::vector<NamedBoundary> Scene::named_boundaries() const
{
  std::vector<NamedBoundary> all;
  for (const BoxPlane &face : box)
    all.push_back({"box_" + face.name, BoundaryKind::plane, face.plane});
  return all;
}

void Scene::summarise(nlohmann::ordered_json &summary) const
{
  Test::summarise(summary);
  summary["time_s"] = engine().time();
  summary["kinetic_energy_J"] = synchronized().energy().kinetic;
}

void Scene::save(std::ostream &out, dem::StateExtent extent) const
{
  Test::save(out, extent);
  dem::write_value(out, time_before);
  dem::write_value(out, is_breaking);
}

void Scene::restore(std::istream &in)
{
  Test::restore(in);
  dem::read_value(in, time_before);
  dem::read_value(in, is_breaking);
  refuse_shorter("Scene/duration", engine().time(), own.scene.duration);
}
} // namespace spall
