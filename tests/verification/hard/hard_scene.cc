#include "hard_scene.h"

#include <cstdarg>

namespace hard
{
std::string text(const char *format, ...)
{
  char line[400];
  va_list values;
  va_start(values, format);
  std::vsnprintf(line, sizeof line, format, values);
  va_end(values);
  return line;
}

Scene::Scene(const dem::EngineParameters &parameters,
             const coupling::ExchangeParameters &rules,
             coupling::ShapeLibrary library)
    : engine(parameters), exchange(rules), shapes(std::move(library))
{
}

coupling::DeformableBody &
Scene::add(std::unique_ptr<coupling::DeformableBody> body,
           const fem::SurfaceMesh &mesh, const std::string &name,
           coupling::ParticleSide side)
{
  bodies.push_back(&exchange.add(std::move(body), mesh, name,
                                 engine.parameters().surface, side, engine));
  return *bodies.back();
}

coupling::DeformableBody &
Scene::add_plate(double mass, double z,
                 const std::function<double(double)> &force,
                 const coupling::BodySteps &steps)
{
  const fem::SurfaceMesh mesh = support::square_at(0.04, z);
  coupling::RigidDrive drive;
  drive.load = [force](double time)
  {
    fem::PlateLoad load;
    load.force.z() = force(time);
    return load;
  };
  return add(std::make_unique<coupling::RigidBody>(support::upright(mass),
                                                   mesh.nodes, drive, steps),
             mesh, "plate", coupling::ParticleSide::inside);
}

fem::Membrane &Scene::add_sheet(const fem::MembraneParameters &membrane,
                                double side, int n)
{
  const fem::SurfaceMesh mesh = support::square_at(side, 0., n);
  fem::Membrane sheet(membrane, mesh);
  std::vector<std::int32_t> rim;
  for (std::size_t k = 0; k < mesh.nodes.size(); ++k)
    if (mesh.nodes[k].head<2>().cwiseAbs().maxCoeff() > 0.4999 * side)
      rim.push_back(static_cast<std::int32_t>(k));
  sheet.tie(rim);
  auto body = std::make_unique<coupling::MembraneBody>(std::move(sheet),
                                                       coupling::BodySteps{});
  coupling::MembraneBody *kept = body.get();
  add(std::move(body), mesh, "membrane", coupling::ParticleSide::outside);
  return kept->membrane();
}

void Scene::advance(double window)
{
  exchange.advance(coupling::particles_of(engine, shapes), window);
}

double Scene::residual() const
{
  double sum = support::energy_residual(engine);
  for (const coupling::DeformableBody *body : bodies)
    sum += support::missing(*body);
  return sum;
}

std::string Scene::state() const
{
  std::ostringstream out(std::ios::binary);
  engine.save(out, shapes);
  exchange.save(out);
  return out.str();
}

void Scene::restore(const std::string &from)
{
  std::istringstream in(from, std::ios::binary);
  engine.restore(in, shapes);
  exchange.restore(in);
}

namespace
{
void go(Scene &scene, const Course &course, int from, int to, bool is_candidate)
{
  for (int k = from; k < to; ++k)
  {
    if (course.before)
      course.before(scene, k);
    scene.advance(course.window);
    if (is_candidate && course.after)
      course.after(scene, k);
  }
}
} // namespace

Restart run(const Make &make, const Course &course)
{
  const std::unique_ptr<Scene> scene = make();
  go(*scene, course, 0, course.n / 2, true);
  const std::string middle = scene->state();
  go(*scene, course, course.n / 2, course.n, true);
  const std::unique_ptr<Scene> resumed = make();
  resumed->restore(middle);
  go(*resumed, course, course.n / 2, course.n, false);
  return resumed->state() == scene->state() ? Restart::same_bits
                                            : Restart::differs;
}

dem::EngineParameters stiff_parameters()
{
  dem::EngineParameters p;
  p.breakage.is_active = false;
  p.gravity = {0., 0., -9.81};
  p.geometry.overlap.stop = 1e9; // the guards of the scenes are tried
  return p;
}

fem::MembraneParameters latex()
{
  fem::MembraneParameters m;
  m.tension = 200.;
  return m;
}

double contact_step(const dem::WallMaterial &contact, double node_mass,
                    double particle_mass)
{
  const double mass = 1. / (1. / node_mass + 1. / particle_mass),
               beta = contact.normal_damping;
  return 2. * (std::sqrt(1. + beta * beta) - beta) *
         std::sqrt(mass / contact.normal_stiffness);
}
} // namespace hard
