#include "case/file.h"
#include "errors.h"
#include "hard_scene.h"
#include "triaxial/triaxial.h"
#include "wall_meshes.h"

#include <dem/engine_boundaries.h>
#include <dem/measure/assembly.h>

#include <shape/test_shapes.h>

// Particles on facets, breaking particles, steps beside the limit.
namespace hard
{
namespace
{
/// A floor with a line of facets along y at x = 0 that rises by `slope` on
/// both sides; particles above.
dem::FacetSurface groove(double slope)
{
  std::vector<dem::Vec3> position;
  for (const double y : {-0.05, 0.05})
    for (const double x : {-0.05, 0., 0.05})
      position.emplace_back(x, y, slope * std::abs(x));
  return support::fixed_surface(position,
                                {{0, 3, 1}, {1, 3, 4}, {1, 4, 2}, {2, 4, 5}});
}

struct Rest
{
  Restart restart = Restart::none;
  double drift = 0., speed = 0.; ///< after the first tenth [m], [m/s]
  int n_steps = 0;
};

/// A ball comes to rest on the surface, then lies there for 1e6 steps.
Rest lie(const dem::FacetSurface &surface, double height)
{
  constexpr double step = 1e-6;
  constexpr int n = 1000000;
  Rest rest;
  rest.n_steps = n;
  dem::Vec3 position;
  rest.restart = run(
      [&]
      {
        dem::EngineParameters p = stiff_parameters();
        p.wall.rolling_friction = p.surface.rolling_friction = 0.1;
        auto scene = std::make_unique<Scene>(p);
        support::add_sphere(scene->engine, 0.01, {0., 0., height});
        dem::attach_surface(scene->engine, surface);
        return scene;
      },
      {step,
       n,
       {},
       [&](Scene &scene, int k)
       {
         const dem::ParticleSystem &particles = scene.engine.particles();
         if (k < n / 10)
           position = particles.position(0);
         else
         {
           rest.drift =
               std::max(rest.drift, (particles.position(0) - position).norm());
           rest.speed = std::max(rest.speed, particles.velocity(0).norm());
         }
       }});
  return rest;
}

Row on(const dem::FacetSurface &surface, double height, double most)
{
  const Rest rest = lie(surface, height);
  Row row;
  row.restart = rest.restart;
  row.happens = text("moves by %.1e m in the last 9e5 of %.0e steps, at most "
                     "%.1e m/s",
                     rest.drift, double(rest.n_steps), rest.speed);
  row.margin = text("limit %.0e m; overlap of its weight 1.1e-9 m", most);
  row.holds = rest.drift < most;
  return row;
}

Row on_vertex()
{
  return on(support::coplanar_fan(6, 0.05, 0.1), 0.01, 1e-9);
}

Row on_edge()
{
  return on(support::coplanar_fan(2, 0.05, 0.1), 0.01, 1e-9);
}

Row between_facets()
{
  return on(groove(1.), 0.01 * std::sqrt(2.), 1e-9);
}

Row in_valley()
{
  const double half = 20. * M_PI / 180.;
  return on(groove(std::tan(half)), 0.01 / std::cos(half), 1e-9);
}

// Three particles so weak that many corners break within one impact.
Row cascade()
{
  constexpr double step = 1e-6;
  const auto make = []
  {
    dem::EngineParameters p = stiff_parameters();
    p.breakage.is_active = true;
    p.breakage.fracture_energy = 100.; // of 1e4
    p.geometry.wall_geometry = dem::ContactGeometry::radial;
    p.surface.normal_stiffness = 1e6;
    p.surface.shear_stiffness = 0.85e6;
    coupling::ShapeLibrary shapes{std::make_shared<const dem::Coefficients>(
        dem::test::random_particle(12, 3))};
    auto scene =
        std::make_unique<Scene>(p, coupling::ExchangeParameters{}, shapes);
    for (int k = 0; k < 3; ++k)
    {
      scene->engine.add_particle(
          dem::make_shape(shapes[0], 0.01),
          {0.004 * k - 0.004, 0.002 * k, 0.014 + 0.026 * k},
          dem::Quaternion::Identity());
      scene->engine.particles().velocity(std::size_t(k)) = {0.1, 0., -2.};
    }
    scene->add_sheet(latex(), 0.1, 6);
    scene->add_plate(0.5, 0.08, [](double) { return -200.; });
    return scene;
  };
  double start = 0., worst = 0., moved = 0., lost = 0., largest = 0.;
  std::int64_t n_events = 0, most = 0;
  Row row;
  row.restart = run(
      make, {step,
             12000,
             {},
             [&](Scene &scene, int k)
             {
               if (k == 0)
                 start = scene.residual();
               worst = std::max(worst, std::abs(scene.residual() - start));
               moved = scene.exchange.ledger().moved;
               most = std::max(most, scene.engine.n_events() - n_events);
               n_events = scene.engine.n_events();
               lost = dem::abrasion(scene.engine.particles(), *dem::one_rank());
               largest = scene.exchange.ledger().work_residual();
             }});
  row.happens =
      text("%lld events, up to %lld in one step, %.2f %% of the mass; "
           "energy off by %.1e of the work that crossed, work "
           "energy_error %.1e",
           (long long)(n_events), (long long)(most), 100. * lost, worst / moved,
           largest);
  row.margin = "limits 1 %, at least 20 events";
  row.holds = worst < 0.01 * moved && largest < 0.01 && n_events >= 20;
  return row;
}

Row beside_the_limit()
{
  spall::Case parameters = spall::read_case(SPALL_SMALL_CASE, {});
  parameters.time.step = spall::StepRule::stable;
  const double limit = spall::Triaxial(parameters).setup_step()->cap;
  parameters.time.step = spall::StepRule::fixed;
  parameters.time.fixed_step = 1.1 * limit;
  Row row;
  std::string refusal;
  try
  {
    spall::Triaxial test(parameters);
  }
  catch (const spall::InputError &error)
  {
    refusal = error.what();
  }
  parameters.time.fixed_step = 0.9 * limit;
  parameters.preparation.pressure = 30e3;
  const auto state = [](const spall::Triaxial &test)
  {
    std::ostringstream out(std::ios::binary);
    test.save(out, dem::StateExtent::scene);
    return out.str();
  };
  spall::Triaxial test(parameters);
  const auto go = [](spall::Triaxial &one, int n)
  {
    for (int k = 0; k < n; ++k)
      one.advance();
    one.engine().synchronize();
  };
  go(test, 1000);
  const std::string middle = state(test);
  go(test, 1000);
  spall::Triaxial resumed(parameters);
  std::istringstream in(middle, std::ios::binary);
  resumed.restore(in);
  go(resumed, 1000);
  row.restart =
      state(resumed) == state(test) ? Restart::same_bits : Restart::differs;
  const auto from = refusal.find("Time/fixed_step");
  row.happens = text("0.9 of %.3g us runs; 1.1 is refused: ", 1e6 * limit) +
                (from == std::string::npos ? refusal : refusal.substr(from));
  row.margin = "the limit is that of one contact: see time_step.md";
  row.holds = !refusal.empty();
  return row;
}
} // namespace

std::vector<Case> particle_cases()
{
  return {{"on_vertex", "a ball lies on the vertex of six coplanar facets",
           "six facets tie for the nearest point", on_vertex},
          {"on_edge", "a ball lies on the edge of two coplanar facets",
           "two facets tie", on_edge},
          {"between_facets", "a ball lies in a groove of 90 degrees",
           "two contacts at 45 degrees that share their load", between_facets},
          {"in_valley",
           "a ball lies in a valley whose normals turn by 40 degrees",
           "one patch that two facets carry", in_valley},
          {"cascade", "particles with a hundredth of the fracture energy",
           "corners break faster than loads can follow", cascade},
          {"step_limit", "fixed steps of 0.9 and 1.1 of the stable one",
           "the second grows without bound", beside_the_limit}};
}
} // namespace hard
