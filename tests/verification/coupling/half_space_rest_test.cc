#include "coupled_scene.h"
#include "solid_scene.h"

#include <coupling/solid_body.h>
#include <dem/engine_boundaries.h>

#include <gtest/gtest.h>

// A sphere at rest on an elastic half-space: the contact is that of Hertz with
// a rigid plate, the ground below gives way as under a point load, in series.
namespace
{
constexpr double radius = 0.01, gravity = 9.81, reach = 0.1;
const fem::SolidLayer soil{5e6, 0.3, 1900.};

/// Cells that grow from the middle to the sides, and downwards.
fem::SolidMesh block(double cell, double growth)
{
  const std::vector<double> outward = fem::graded_widths(cell, growth, reach);
  fem::BoxMesh box;
  box.lower = {-reach, -reach, -reach};
  for (std::size_t c = 0; c < 3; ++c)
  {
    box.widths[c].assign(outward.rbegin(), outward.rend());
    if (c < 2)
      box.widths[c].insert(box.widths[c].end(), outward.begin(), outward.end());
  }
  return fem::box_mesh(box);
}

/// Far sides are moved as a point load on the half-space moves them.
fem::Solid half_space(const fem::SolidMesh &mesh, double weight)
{
  fem::SolidParameters p;
  p.layers = {soil};
  p.mass_damping = 1500.;
  fem::Solid solid(p, mesh);
  const support::PointLoad field{weight, soil};
  for (const auto side :
       {fem::x_lower, fem::x_upper, fem::y_lower, fem::y_upper, fem::z_lower})
  {
    solid.fix(side, {true, true, true});
    for (const std::int32_t node : fem::boundary_nodes(mesh, side))
      solid.set_support_displacement(
          node, field(mesh.nodes[static_cast<std::size_t>(node)]));
  }
  solid.settle(support::no_loads(solid));
  return solid;
}

struct Rest
{
  double overlap = 0.; ///< of the sphere, over Hertz [-]
  double ground = 0.;  ///< settlement under the sphere, over that of its loads
  double middle_share = 0.; ///< of the loads, that on the node under it [-]
  double field = 0.;        ///< mean settlement around, over Boussinesq [-]
  double series = 0.; ///< way of the sphere over overlap and settlement [-]
};

Rest rest(double cell, double growth)
{
  dem::EngineParameters p = support::bare_parameters();
  p.surface.law = "hertz";
  p.surface.normal_damping = 0.5;
  p.gravity = {0., 0., -gravity};
  p.local_damping = 0.3;
  dem::Engine engine(p);
  support::add_sphere(engine, radius, {0., 0., radius - 7e-7});
  const double weight = engine.particles().mass(0) * gravity;
  coupling::Exchange exchange({});
  const fem::SolidMesh mesh = block(cell, growth);
  auto ground = std::make_unique<coupling::SolidBody>(
      half_space(mesh, weight), fem::z_upper, coupling::BodySteps{});
  const coupling::SolidBody &body = *ground;
  const fem::SurfaceMesh top = ground->mesh();
  const coupling::DeformableBody &joined =
      exchange.add(std::move(ground), top, "ground", p.surface,
                   coupling::ParticleSide::outside, engine);
  const auto particles = coupling::particles_of(engine, support::no_shapes());
  for (int k = 0; k < 4000; ++k)
    exchange.advance(particles, 1e-5);

  const double modulus =
      p.particle.shear_modulus / (1. - p.particle.poisson_ratio);
  // 1 / E* = (1 - nu) / (2 G): the plate is rigid.
  const double hertz =
      std::pow(weight / (4. / 3. * 2. * modulus * std::sqrt(radius)), 2. / 3.);
  const dem::ContactBatch &batch = dem::on_facets(engine);
  const std::size_t touch = support::only_nearest_point(batch);
  Rest seen;
  if (touch == batch.size())
    return seen;
  seen.overlap = batch.overlap[touch] / hertz;
  const auto down = body.solid().displacements();
  const auto middle =
      static_cast<std::size_t>(support::node_at(mesh, dem::Vec3::Zero()));
  fem::Solid still = half_space(mesh, weight);
  auto load = support::no_loads(still);
  // In the pit the sphere overlaps the facets round the node too.
  const coupling::FieldView on_top = exchange.load_on(joined);
  for (std::size_t k = 0; k < on_top.size(); ++k)
    load[static_cast<std::size_t>(support::node_at(mesh, top.nodes[k]))] =
        on_top[k];
  still.settle(load);
  seen.middle_share = -load[middle].z() / weight;
  seen.ground = down[middle].z() / still.displacements()[middle].z();
  seen.series = (radius - engine.particles().position(0).z()) /
                (batch.overlap[touch] - down[middle].z());
  const double nu = soil.poisson_ratio;
  int n = 0;
  for (std::size_t k = 0; k < mesh.nodes.size(); ++k)
  {
    const double r = mesh.nodes[k].norm();
    if (mesh.nodes[k].z() < -1e-9 || r < 0.02 || r > 0.06)
      continue;
    seen.field -= down[k].z() * M_PI * soil.youngs_modulus * r /
                  ((1. - nu * nu) * weight);
    ++n;
  }
  seen.field /= n;
  return seen;
}
} // namespace

// The settlement under the sphere is that of the mesh under the loads on its
// nodes, nearly all of them on the one below.
TEST(SphereOnHalfSpace, HertzInSeriesWithTheGround)
{
  const Rest seen = rest(0.006, 1.5);
  std::printf("overlap / Hertz %.5f, ground %.5f, on the node %.5f, field "
              "%.4f, series %.5f\n",
              seen.overlap, seen.ground, seen.middle_share, seen.field,
              seen.series);
  EXPECT_NEAR(seen.overlap, 1., 2e-3);
  EXPECT_NEAR(seen.ground, 1., 1e-3);
  EXPECT_NEAR(seen.middle_share, 1., 4e-3);
  // The pit is deeper than where it touches.
  EXPECT_NEAR(seen.series, 1., 4e-3);
  EXPECT_NEAR(seen.field, 1., 0.05); // cells of 6 to 30 mm
}
