#include "coupled_scene.h"
#include "solid_scene.h"

#include <coupling/membrane_body.h>
#include <coupling/solid_body.h>
#include <dem/engine_boundaries.h>

#include <gtest/gtest.h>

// Everything at once: a subgrade with absorbing sides below, particles on it, a
// membrane round them, a plate with a haversine on top.
namespace
{
using coupling::ExchangeRule;

constexpr double step = 5e-6, weight = 30.;

struct Scene
{
  dem::Engine engine;
  coupling::Exchange exchange;
  std::vector<const coupling::DeformableBody *> bodies;

  static dem::EngineParameters parameters()
  {
    dem::EngineParameters p;
    p.breakage.is_active = false;
    p.surface.normal_stiffness = 1e5;
    p.surface.shear_stiffness = 0.85e5;
    p.surface.normal_damping = p.surface.shear_damping = 0.2;
    p.gravity = {0., 0., -9.81};
    return p;
  }
  static coupling::ExchangeParameters rules(ExchangeRule rule, int n)
  {
    coupling::ExchangeParameters r;
    r.rule = rule;
    r.particle_steps = n;
    return r;
  }
  const coupling::DeformableBody &
  add(std::unique_ptr<coupling::DeformableBody> body,
      const fem::SurfaceMesh &mesh, const std::string &name,
      coupling::ParticleSide side)
  {
    bodies.push_back(&exchange.add(std::move(body), mesh, name,
                                   engine.parameters().surface, side, engine));
    return *bodies.back();
  }

  explicit Scene(ExchangeRule rule, int n = 1)
      : engine(parameters()), exchange(rules(rule, n))
  {
    for (int k = 0; k < 12; ++k)
      support::add_sphere(engine, 0.01,
                          {0.0202 * (k % 2) - 0.0102,
                           0.0201 * (k / 2 % 2) - 0.01,
                           0.0099 + 0.0198 * (k / 4)});
    const bool is_free = rule != ExchangeRule::every_step;

    fem::SolidMesh ground = support::box({0.12, 0.12, 0.06}, {4, 4, 2});
    for (dem::Vec3 &node : ground.nodes)
      node -= dem::Vec3(0.06, 0.06, 0.06);
    fem::SolidParameters soil;
    soil.layers = {{5e6, 0.3, 1800.}};
    fem::Solid solid(soil, ground);
    solid.fix(fem::z_lower, {true, true, true});
    for (const auto side :
         {fem::x_lower, fem::x_upper, fem::y_lower, fem::y_upper})
      solid.absorb(side);
    auto subgrade = std::make_unique<coupling::SolidBody>(
        std::move(solid), fem::z_upper, coupling::BodySteps{is_free, 1});
    const fem::SurfaceMesh top = subgrade->mesh();
    add(std::move(subgrade), top, "subgrade", coupling::ParticleSide::outside);

    const fem::SurfaceMesh round = fem::box_sides(
        {-0.0205, -0.0203, 0.}, {0.0205, 0.0203, 0.062}, {3, 3, 4});
    fem::MembraneParameters latex;
    latex.thickness = 2e-3;
    fem::Membrane membrane(latex, round);
    membrane.tie(fem::nodes_at_height(round, 0., 1e-6));
    membrane.tie(fem::nodes_at_height(round, 0.062, 1e-6));
    membrane.set_pressure(2e3);
    add(std::make_unique<coupling::MembraneBody>(
            std::move(membrane), coupling::BodySteps{false, is_free ? 2 : 1}),
        round, "membrane", coupling::ParticleSide::inside);

    const fem::SurfaceMesh lid = support::square_at(0.04, 0.0594);
    coupling::RigidDrive drive;
    drive.load = [](double time)
    {
      fem::PlateLoad load;
      load.force.z() = -weight * (1.5 - 0.5 * std::cos(400. * time));
      return load;
    };
    fem::PlateBodyParameters plate;
    plate.mass = 1.;
    plate.inertia = {2e-3, 2e-3, 3e-3};
    plate.centre = {0., 0., 0.0594};
    add(std::make_unique<coupling::RigidBody>(plate, lid.nodes, drive), lid,
        "plate", coupling::ParticleSide::inside);
  }

  double residual() const
  {
    double sum = support::energy_residual(engine);
    for (const coupling::DeformableBody *body : bodies)
      sum += support::missing(*body);
    return sum;
  }
  void advance(double window, int n)
  {
    const auto particles = coupling::particles_of(engine, support::no_shapes());
    for (int k = 0; k < n; ++k)
      exchange.advance(particles, window);
  }
  std::string state() const
  {
    std::ostringstream out(std::ios::binary);
    engine.save(out, support::no_shapes());
    exchange.save(out);
    return out.str();
  }
};
} // namespace

TEST(WholeScene, ClosesAndContinues)
{
  const struct
  {
    ExchangeRule rule;
    int particle_steps;
  } ways[] = {{ExchangeRule::every_step, 1},
              {ExchangeRule::one_pass, 2},
              {ExchangeRule::iterated, 4}};
  for (const auto &way : ways)
  {
    const int n = way.particle_steps;
    Scene scene(way.rule, n);
    const double start = scene.residual();
    scene.advance(n * step, 2000 / n);
    const coupling::LedgerSums &sums = scene.exchange.ledger();
    EXPECT_LT(sums.work_residual(), 1e-2) << n;
    EXPECT_LT(sums.impulse_residual(), 1e-11) << n;
    EXPECT_LT(std::abs(scene.residual() - start), 2e-2 * sums.moved) << n;
    for (const dem::FacetBoundary &facets : dem::surfaces(scene.engine))
    {
      double load = 0.;
      for (const dem::Vec3 &on_vertex : facets.surface.load)
        load += on_vertex.norm();
      EXPECT_GT(load, 1e-2) << facets.label;
    }
    std::printf(
        "way %d: interface energy error %.1e, energy %.1e of what crossed\n",
        int(way.rule), sums.work_residual(),
        std::abs(scene.residual() - start) / sums.moved);
    const std::string middle = scene.state();
    scene.advance(n * step, 200 / n);
    Scene resumed(way.rule, n);
    std::istringstream in(middle, std::ios::binary);
    resumed.engine.restore(in, support::no_shapes());
    resumed.exchange.restore(in);
    resumed.advance(n * step, 200 / n);
    EXPECT_EQ(resumed.state(), scene.state()) << n;
  }
}
