#include "bench_scene.h"

#include "errors.h"
#include "parameter.h"
#include "shape_file.h"

#include <dem/packing/random.h>

#include <algorithm>
#include <cmath>

namespace spall
{
namespace
{
constexpr double gravity = 9.81;      // [m/s^2]
constexpr double pressure = 30e3;     // of the closed box [Pa]
constexpr double closing_speed = 1.;  // of one wall at most [m/s]
constexpr int closing_steps = 40000;  // at most
constexpr int closing_interval = 200; // [steps]

/// The peers' material: E = 1.25e9 Pa, nu = 0.25, so G = E / (2 (1 + nu)) =
/// 5e8 Pa. Restitution e = 0.4 from contact to zero overlap, as the peer
/// LIGGGHTS takes it: its dashpot 2 sqrt(5/6) b sqrt(k m*) with
/// b = |ln e| / sqrt(pi^2 + ln^2 e) is ours with beta = sqrt(5/6) b = 0.2556.
dem::StoneMaterial stone_material()
{
  dem::StoneMaterial stone;
  stone.density = 2750.;
  stone.shear_modulus = 5e8;
  stone.poisson_ratio = 0.25;
  stone.friction = 0.5;
  stone.rolling_friction = 0.2;
  stone.normal_damping = stone.shear_damping = 0.2556;
  return stone;
}

/// Linear walls in place of the peers' Hertz walls: k_n such that all wall
/// contacts of the peers' packings together press as hard (sum of the Hertz
/// forces over the sum of the overlaps, 2.90e5 and 2.86e5 N/m), k_s / k_n =
/// 9/7 as Mindlin to the secant of Hertz at nu = 1/4, beta = b above. A
/// sphere of 5 mm diameter, 0.18 g, is stable on it up to 2e-5 s.
dem::WallMaterial wall_material()
{
  dem::WallMaterial wall;
  wall.normal_stiffness = 2.9e5;
  wall.shear_stiffness = 9. / 7. * wall.normal_stiffness;
  wall.friction = 0.5;
  wall.rolling_friction = 0.2;
  wall.normal_damping = wall.shear_damping = 0.28;
  return wall;
}

dem::EngineParameters parameters_of_bench()
{
  dem::EngineParameters parameters;
  parameters.stone = stone_material();
  parameters.wall = parameters.surface = wall_material();
  parameters.gravity = -gravity * dem::Vec3::UnitZ();
  parameters.search_margin = 5e-4; // the skin of the peers
  parameters.breakage.is_active = false;
  return parameters;
}

std::unique_ptr<dem::Engine>
fill_engine(const BenchStones &stones, const dem::EngineParameters &parameters)
{
  auto engine = std::make_unique<dem::Engine>(parameters);
  const Packing &packing = stones.packing;
  for (std::size_t k = 0; k < packing.size(); ++k)
    engine->add_stone(stones.bodies[k], packing.position[k],
                      packing.orientation.empty() ? dem::Quaternion::Identity()
                                                  : packing.orientation[k]);
  return engine;
}

/// Where the stones of the engine are and how they move: all that this file
/// reads and writes of its columns.
void set_velocities(dem::Engine &engine,
                    const std::vector<dem::Vec3> &velocities)
{
  engine.particles().velocity = velocities;
}

void take_state(const dem::Engine &engine, Packing &packing)
{
  packing.position = engine.particles().position;
  packing.orientation = engine.particles().orientation;
}

void require_stable(const dem::Engine &engine)
{
  const dem::StepLimit limit =
      dem::critical_step(engine.parameters(), engine.particles());
  if (bench_step > limit.step)
    throw InputError("bench: the time step of " + number_text(bench_step) +
                     " s must be at most " + number_text(limit.step) +
                     " s for these stones, set by: " + limit.reason);
}

/// Moves everything away from the origin so that the circumscribed spheres of
/// stones whose balls touch come apart.
void spread(BenchStones &stones)
{
  Packing &packing = stones.packing;
  double factor = 1.;
  for (std::size_t k = 0; k < packing.size(); ++k)
    factor = std::max(factor, stones.bodies[k].circumscribed_radius /
                                  packing.radius[k]);
  packing.box *= factor;
  for (dem::Vec3 &x : packing.position)
    x *= factor;
}

/// The stones come together as fast as the walls, so that the box closes
/// evenly.
void close_evenly(dem::Engine &engine, const Packing &packing)
{
  const dem::Vec3 centre = 0.5 * packing.box;
  std::vector<dem::Vec3> velocities;
  for (const dem::Vec3 &x : packing.position)
    velocities.push_back(closing_speed * (centre - x).cwiseQuotient(centre));
  set_velocities(engine, velocities);
}

bool is_closed(const dem::Engine &engine, const dem::BoxPlanes &box,
               ClosedBox &reached)
{
  reached.stress = dem::box_stress(engine, box);
  reached.unbalanced_ratio =
      dem::unbalanced_force_ratio(engine.particles(), engine.pairs());
  return (reached.stress.array() / pressure - 1.).abs().maxCoeff() < 0.02 &&
         reached.unbalanced_ratio < 0.01 && reached.unbalanced_ratio > 0.;
}

} // namespace

BenchStones make_bench_stones(Packing packing, const std::string &shapes)
{
  BenchStones stones;
  std::vector<dem::Body> unit;
  if (!shapes.empty())
    for (const ShapeFile &shape : read_shapes(shapes))
      unit.push_back(dem::make_body(
          std::make_shared<const dem::Coefficients>(shape.coefficients), 1.));
  for (std::size_t k = 0; k < packing.size(); ++k)
    stones.bodies.push_back(
        unit.empty() ? dem::make_sphere(packing.radius[k])
                     : dem::resized(unit[k % unit.size()], packing.radius[k]));
  if (!unit.empty() && packing.orientation.empty())
  {
    dem::Random random(1);
    for (std::size_t k = 0; k < packing.size(); ++k)
      packing.orientation.push_back(random.rotation());
  }
  stones.packing = std::move(packing);
  return stones;
}

ClosedBox close_box(BenchStones &stones)
{
  spread(stones);
  dem::EngineParameters parameters = parameters_of_bench();
  parameters.gravity.setZero();
  parameters.stone.friction = parameters.stone.rolling_friction = 0.;
  parameters.wall.friction = parameters.wall.rolling_friction = 0.;
  parameters.local_damping = 0.7;
  const std::unique_ptr<dem::Engine> engine = fill_engine(stones, parameters);
  const dem::BoxPlanes box =
      dem::add_box(*engine, dem::Vec3::Zero(), stones.packing.box);
  close_evenly(*engine, stones.packing);
  dem::BoxServo servo(box, {5e-4, closing_speed});
  for (int d = 0; d < 3; ++d)
    servo.follow(d, pressure);
  ClosedBox reached;
  require_stable(*engine);
  reached.step = settling_step(*engine);
  do
    for (int step = 0; step < closing_interval; ++step)
    {
      servo.update(*engine, reached.step);
      engine->advance(reached.step);
    }
  while (!is_closed(*engine, box, reached) &&
         engine->n_steps() < closing_steps);
  reached.n_steps = engine->n_steps();
  take_state(*engine, stones.packing);
  dem::Vec3 lower;
  for (int d = 0; d < 3; ++d)
    lower[d] = engine->planes()[box[static_cast<std::size_t>(d)][0]].point[d];
  for (dem::Vec3 &x : stones.packing.position)
    x -= lower;
  stones.packing.box = dem::box_size(*engine, box);
  return reached;
}

std::unique_ptr<dem::Engine>
make_bench_engine(const BenchStones &stones, BenchScene scene, bool is_breaking)
{
  dem::EngineParameters parameters = parameters_of_bench();
  parameters.breakage.is_active = is_breaking;
  std::unique_ptr<dem::Engine> engine = fill_engine(stones, parameters);
  require_stable(*engine);
  dem::Vec3 upper = stones.packing.box;
  if (scene == BenchScene::collapse)
    upper.x() *= 1.6;
  dem::add_box(*engine, dem::Vec3::Zero(), upper);
  return engine;
}

double settling_step(const dem::Engine &engine)
{
  return std::min(
      4e-6,
      0.2 * dem::critical_step(engine.parameters(), engine.particles()).step);
}

void start_scene(dem::Engine &engine, BenchScene scene)
{
  if (scene == BenchScene::jolt)
    set_velocities(engine, std::vector<dem::Vec3>(engine.particles().size(),
                                                  dem::Vec3(0.1, 0., -0.3)));
}
} // namespace spall
