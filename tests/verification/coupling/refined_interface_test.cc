#include "coupled_scene.h"
#include "solid_scene.h"

#include <coupling/solid_body.h>
#include <dem/engine_boundaries.h>

#include <gtest/gtest.h>

// Particles on a body whose cells are halved below a part of its top: where
// small quads meet a larger one, hanging nodes stand in the middle of its
// edges.
namespace
{
constexpr double side = 0.4, radius = 0.03, stiffness = 1e5;
/// In the middle of the edge between (0.2, 0, 0.2) and (0.2, 0.1, 0.2).
const dem::Vec3 junction(0.2, 0.05, 0.2);

fem::Solid refined_block()
{
  fem::BoxMesh box;
  for (std::size_t c = 0; c < 3; ++c)
    box.widths[c].assign(c == 2 ? 2 : 4, 0.1);
  box.refined.push_back({dem::Vec3::Zero(), {0.2, side, 0.3}, 1});
  fem::SolidParameters p;
  p.layers = {{2e6, 0.3, 2000.}};
  fem::Solid solid(p, fem::box_mesh(box));
  solid.fix(fem::z_lower, {true, true, true});
  return solid;
}

enum class Way
{
  explicit_steps,
  implicit_steps,
  condensed
};

/// The block with a sphere on the junction that falls by its weight.
struct Scene : support::SphereOnBody
{
  explicit Scene(Way way, double its_step)
      : SphereOnBody(falling_on(stiffness), rules(way), its_step)
  {
    std::unique_ptr<coupling::DeformableBody> its_body;
    fem::SurfaceMesh mesh;
    if (way == Way::condensed)
    {
      auto condensed = std::make_unique<coupling::CondensedBody>(
          refined_block(), fem::z_upper, 1000, 1, step);
      mesh = condensed->mesh();
      its_body = std::move(condensed);
    }
    else
    {
      auto solid = std::make_unique<coupling::SolidBody>(
          refined_block(), fem::z_upper,
          coupling::BodySteps{way == Way::implicit_steps, 1});
      mesh = solid->mesh();
      its_body = std::move(solid);
    }
    support::add_sphere(engine, radius,
                        junction + dem::Vec3(0., 0., radius - 1e-6));
    body = &exchange.add(std::move(its_body), mesh, "block",
                         engine.parameters().surface,
                         coupling::ParticleSide::outside, engine);
  }

  static coupling::ExchangeParameters rules(Way way)
  {
    coupling::ExchangeParameters p;
    if (way != Way::explicit_steps)
      p.rule = coupling::ExchangeRule::one_pass;
    return p;
  }
};
} // namespace

// An edge of one facet only lies on the rim of the top.
TEST(RefinedInterface, HasNoCracks)
{
  Scene scene(Way::explicit_steps, 1e-5);
  const dem::FacetSurface &surface =
      dem::facet_boundary(scene.engine, 0).surface;
  const dem::FacetTopology topology(surface);
  std::size_t n_rim = 0;
  double area = 0.;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    const auto corner = dem::corners_of(surface, std::int32_t(t));
    area += 0.5 * (corner[1] - corner[0]).cross(corner[2] - corner[0]).z();
    for (std::size_t e = 0; e < 3; ++e)
      if (topology.neighbour[t][e] < 0)
      {
        ++n_rim;
        const dem::Vec3 middle = 0.5 * (corner[e] + corner[(e + 1) % 3]);
        const double to_rim = std::min(
            {middle.x(), side - middle.x(), middle.y(), side - middle.y()});
        EXPECT_LT(to_rim, 1e-12) << middle.transpose();
      }
  }
  EXPECT_EQ(n_rim, 8u + 2u * (4u + 2u) + 4u);
  EXPECT_NEAR(std::abs(area), side * side, 1e-14);
}

// A force F on a midpoint is F / 2 on either end and moves it by
// F / (4 m) + F / (4 m'): its dashpot feels that mass, and the exchange gain is
// that of the lighter end with half of the spring.
TEST(RefinedInterface, MidpointsWeighAsTheirEnds)
{
  Scene scene(Way::explicit_steps, 1e-5);
  const coupling::FieldView at = scene.body->motion().position;
  const std::vector<double> mass = scene.body->nodal_mass();
  double over = 0., lightest = 1e300;
  std::size_t middle = at.size();
  for (std::size_t k = 0; k < at.size(); ++k)
  {
    const double far = (at[k] - junction).norm();
    if (far < 1e-9)
      middle = k;
    else if (far < 0.0501 && std::abs(at[k].x() - 0.2) < 1e-9)
    {
      over += 0.25 / mass[k];
      lightest = std::min(lightest, mass[k]);
    }
  }
  ASSERT_LT(middle, at.size());
  const dem::FacetSurface &surface =
      dem::facet_boundary(scene.engine, 0).surface;
  EXPECT_NEAR(surface.mass[middle], 1. / over, 1e-12 / over);
  scene.run(scene.step);
  EXPECT_NEAR(scene.exchange.gain(scene.engine, scene.step),
              0.5 * 1e5 / lightest * scene.step * scene.step / 4., 1e-12);
}

// The three ways to move the body agree, and nothing is lost at the junction.
TEST(RefinedInterface, CarriesASphere)
{
  std::array<double, 3> height{};
  for (const Way way :
       {Way::explicit_steps, Way::implicit_steps, Way::condensed})
  {
    Scene scene(way, 2e-5);
    const double start = scene.height();
    scene.run(0.01);
    height[std::size_t(way)] = scene.height();
    EXPECT_LT(scene.exchange.ledger().work_residual(),
              way == Way::explicit_steps ? 1e-12 : 1e-6);
    const double crossed = scene.exchange.ledger().moved;
    EXPECT_NEAR(support::residual(scene.engine, {scene.body}), 0.,
                2e-5 * crossed);
    EXPECT_LT(scene.height(), start);
  }
  const double sunk = junction.z() + radius - height[0];
  EXPECT_NEAR(height[1], height[0], 1e-5 * sunk);
  EXPECT_NEAR(height[2], height[1], 1e-9 * sunk);
}
