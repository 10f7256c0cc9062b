#include "coupled_scene.h"

#include <coupling/membrane_body.h>
#include <dem/engine_boundaries.h>

#include <gtest/gtest.h>

// A sphere on a membrane some of whose quads are halved, on a node in the
// middle of an edge of a larger quad.
namespace
{
constexpr double side = 0.4, radius = 0.02, stiffness = 1e4;
/// Of 4 x 4 quads those of the upper half are halved.
const dem::Vec3 junction(0.05, 0., 0.);

struct Scene : support::SphereOnBody
{
  Scene(coupling::ExchangeRule rule, double its_step)
      : SphereOnBody(falling_on(stiffness), rules(rule), its_step)
  {
    support::add_sphere(engine, radius,
                        junction + dem::Vec3(0., 0., radius - 1e-6));
    const bool is_explicit = rule == coupling::ExchangeRule::every_step;
    fem::Membrane membrane = tight_square();
    const fem::SurfaceMesh mesh = membrane.mesh();
    body = &exchange.add(
        std::make_unique<coupling::MembraneBody>(
            std::move(membrane), coupling::BodySteps{!is_explicit, 1}),
        mesh, "membrane", engine.parameters().surface,
        coupling::ParticleSide::outside, engine);
  }

  static fem::Membrane tight_square()
  {
    fem::MembraneParameters p;
    p.tension = 500.;
    p.density = 2000.;
    std::vector<std::int32_t> upper;
    for (std::int32_t k = 8; k < 16; ++k)
      upper.push_back(k);
    fem::Membrane membrane(
        p, fem::halve_quads(support::square_at(side, 0., 4), upper));
    std::vector<std::int32_t> rim;
    for (std::size_t k = 0; k < membrane.n_nodes(); ++k)
      if (membrane.mesh().nodes[k].head<2>().cwiseAbs().maxCoeff() >
          0.4999 * side)
        rim.push_back(static_cast<std::int32_t>(k));
    membrane.tie(rim);
    return membrane;
  }

  static coupling::ExchangeParameters rules(coupling::ExchangeRule rule)
  {
    coupling::ExchangeParameters p;
    p.rule = rule;
    p.tolerance = 1e-12;
    p.particle_steps = 1;
    return p;
  }
};
} // namespace

// A force F on a midpoint is F / 2 on either end.
TEST(HalvedMembraneInterface, MidpointsWeighAsTheirEnds)
{
  Scene scene(coupling::ExchangeRule::every_step, 1e-5);
  const coupling::FieldView at = scene.body->motion().position;
  const std::vector<double> mass = scene.body->nodal_mass();
  double over = 0.;
  std::size_t middle = at.size();
  for (std::size_t k = 0; k < at.size(); ++k)
    if ((at[k] - junction).norm() < 1e-9)
      middle = k;
    else if ((at[k] - junction).norm() < 0.0501 && std::abs(at[k].y()) < 1e-9)
      over += 0.25 / mass[k];
  ASSERT_LT(middle, at.size());
  EXPECT_TRUE(std::isinf(mass[middle]));
  const dem::FacetSurface &surface =
      dem::facet_boundary(scene.engine, 0).surface;
  EXPECT_NEAR(surface.mass[middle], 1. / over, 1e-12 / over);
}

// Explicit and implicit steps agree, and nothing is lost at the junction.
TEST(HalvedMembraneInterface, CarriesASphere)
{
  std::array<double, 2> sunk{};
  for (const auto rule :
       {coupling::ExchangeRule::every_step, coupling::ExchangeRule::iterated})
  {
    const bool is_explicit = rule == coupling::ExchangeRule::every_step;
    Scene scene(rule, 2e-5);
    const double start = scene.height();
    scene.run(0.01);
    EXPECT_LT(scene.exchange.ledger().work_residual(),
              is_explicit ? 1e-12 : 1e-6);
    const double crossed = scene.exchange.ledger().moved;
    EXPECT_NEAR(support::residual(scene.engine, {scene.body}), 0.,
                1e-4 * crossed);
    sunk[is_explicit ? 0 : 1] = start - scene.height();
  }
  std::printf("sunk %.6e m, %.6e m\n", sunk[0], sunk[1]);
  EXPECT_GT(sunk[0], 1e-5);
  EXPECT_NEAR(sunk[1], sunk[0], 1e-3 * sunk[0]);
}
