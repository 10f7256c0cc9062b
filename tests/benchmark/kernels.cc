// Kernels of the particle engine; each call of a loop body is one item.
#include "scenes.h"

#include <dem/breakage/update.h>
#include <dem/contact/elliptic.h>
#include <dem/contact/laws/hertz.h>
#include <dem/contact/side.h>
#include <dem/neighbor/candidates.h>
#include <dem/shape/patch.h>
#include <dem/shape/radius_map.h>

#include <benchmark/benchmark.h>
#include <cmath>

namespace
{
using benchmark::State;
using benchmark_scenes::directions;

constexpr int n_inputs = 1024;

/// One step of a touching contact over plain numbers: springs, sliders,
/// dashpots, energy. The engine works on lanes of them: see engine_step.
void contact_law(State &state)
{
  const dem::ContactCoefficients pair{0.5, 0.2, 0.27, 0.27};
  std::vector<dem::ContactHistory<double>> history(n_inputs);
  std::vector<dem::ContactMotion<double>> motion(n_inputs);
  const std::vector<dem::Vec3> normals = directions(n_inputs);
  const auto triple = [](const dem::Vec3 &v) {
    return dem::Triple<double>{v.x(), v.y(), v.z()};
  };
  for (std::size_t k = 0; k < n_inputs; ++k)
  {
    motion[k].normal = motion[k].normal_before = triple(normals[k]);
    motion[k].velocity = motion[k].velocity_before =
        triple(0.01 * normals[(k + 7) % n_inputs]);
    motion[k].spin = triple(normals[(k + 13) % n_inputs]);
    motion[k].reduced_mass = 1e-3;
    motion[k].rolling_radius = 2.5e-3;
  }
  dem::Dissipation lost;
  std::size_t k = 0;
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(dem::advance_contact<dem::Hertz>(
        motion[k], dem::Hertz::spring<double>({}, {4e7, 5e7}, 1e-5), pair, 1e-6,
        history[k], lost));
    k = (k + 1) % n_inputs;
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(contact_law);

void elliptic_prefactors(State &state)
{
  const dem::PairElasticity pair =
      dem::mix({5e8, 0.25, false}, {5e8, 0.25, false});
  const dem::EllipticTable &table = dem::elliptic_table();
  std::vector<dem::GapCoefficients> gaps;
  for (std::size_t k = 0; k < n_inputs; ++k)
    gaps.push_back(
        dem::gap_coefficients({200. + static_cast<double>(k), 150., 180., 60.,
                               std::cos(static_cast<double>(k))}));
  std::size_t k = 0;
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(table(pair, gaps[k]));
    k = (k + 1) % n_inputs;
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(elliptic_prefactors);

/// The rounded cube, cut at the order that the argument names.
dem::ParticleShape cube_of_order(const State &state)
{
  const dem::ParticleShape cube = benchmark_scenes::rounded_cube(5e-3);
  const auto n = dem::n_coefficients(static_cast<int>(state.range(0)));
  return dem::make_shape(std::make_shared<const dem::Coefficients>(
                             cube.series->begin(), cube.series->begin() + n),
                         5e-3);
}

/// Calls `evaluate` with the rounded cube and one direction after the other.
template <class Evaluate>
void over_directions(State &state, const Evaluate &evaluate)
{
  const dem::ParticleShape body = cube_of_order(state);
  const std::vector<dem::Vec3> ways = directions(n_inputs);
  std::size_t k = 0;
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(evaluate(body, ways[k]));
    k = (k + 1) % n_inputs;
  }
  state.SetItemsProcessed(state.iterations());
}

void orders(benchmark::internal::Benchmark *kernel)
{
  kernel->ArgName("order")->Arg(8)->Arg(20);
}

void series_radius(State &state)
{
  over_directions(state, [](const dem::ParticleShape &body, const dem::Vec3 &s)
                  { return dem::radius(*body.series, s); });
}
BENCHMARK(series_radius)->Apply(orders);

void series_expand(State &state)
{
  over_directions(state, [](const dem::ParticleShape &body, const dem::Vec3 &s)
                  { return dem::expand(*body.series, s); });
}
BENCHMARK(series_expand)->Apply(orders);

/// All directions in one call; an item is one direction.
void series_expand_many(State &state)
{
  const dem::ParticleShape body = cube_of_order(state);
  const std::vector<dem::Vec3> ways = directions(n_inputs);
  std::vector<dem::RadialExpansion> expansions(n_inputs);
  for (auto _ : state)
  {
    dem::expand(*body.series, ways, expansions);
    benchmark::DoNotOptimize(expansions.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * n_inputs);
}
BENCHMARK(series_expand_many)->Apply(orders);

void series_curvatures(State &state)
{
  over_directions(
      state, [](const dem::ParticleShape &body, const dem::Vec3 &s)
      { return dem::principal_curvatures(dem::expand(*body.series, s)); });
}
BENCHMARK(series_curvatures)->Apply(orders);

/// Expansion and curvatures of one side of a contact.
void side_evaluation(State &state)
{
  over_directions(state, [](const dem::ParticleShape &body, const dem::Vec3 &s)
                  { return dem::evaluate_side(body, s, 10.); });
}
BENCHMARK(side_evaluation)->Apply(orders);

/// One event: kernel, depth, new coefficients and all that follows from them.
void breakage_event(State &state)
{
  over_directions(state,
                  [](const dem::ParticleShape &body, const dem::Vec3 &s)
                  {
                    const double overlap = 2e-5, gauss = 1e6;
                    const dem::Spall spall{
                        s, dem::cap_of(overlap, gauss).volume, overlap, gauss};
                    return dem::apply_spall(body, spall, {}).depth;
                  });
}
BENCHMARK(breakage_event)->Apply(orders)->Unit(benchmark::kMicrosecond);

/// What the search for contact points looks up, of a shape that has just
/// changed.
void radius_map(State &state)
{
  const dem::ParticleShape body = cube_of_order(state);
  for (auto _ : state)
    benchmark::DoNotOptimize(dem::RadiusMap(body.series));
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(radius_map)->Apply(orders)->Unit(benchmark::kMicrosecond);

benchmark_scenes::ParticleSystem kind_of(const State &state)
{
  return state.range(1) != 0 ? benchmark_scenes::ParticleSystem::shapes
                             : benchmark_scenes::ParticleSystem::spheres;
}

/// Candidate pairs anew, with the history of all that stay.
void list_rebuild(State &state)
{
  const auto engine = benchmark_scenes::lattice(
      static_cast<int>(state.range(0)), kind_of(state));
  dem::ContactBatch batch = engine->pairs();
  dem::LostEnergy retired;
  const double margin = engine->parameters().geometry.usual_skin;
  const dem::ContactGeometry geometry = engine->particles().has_shapes
                                            ? dem::ContactGeometry::radial
                                            : dem::ContactGeometry::sphere;
  for (auto _ : state)
  {
    dem::PairFinder finder; // knows nothing yet
    dem::rebuild_pairs(engine->particles(), batch.layout,
                       finder.find(engine->particles(), geometry, margin, {}),
                       batch, retired);
  }
  state.SetItemsProcessed(state.iterations() *
                          static_cast<std::int64_t>(batch.size()));
}

/// Frozen steps of an engine; an item is one touching pair.
void step_engine(State &state, dem::Engine &engine)
{
  std::int64_t n_touching = 0;
  for (std::size_t k = 0; k < engine.pairs().size(); ++k)
    n_touching += engine.pairs().is_touching(k);
  for (auto _ : state)
    engine.advance(benchmark_scenes::frozen_step);
  state.SetItemsProcessed(state.iterations() * n_touching);
}

void engine_step(State &state)
{
  step_engine(state, *benchmark_scenes::lattice(
                         static_cast<int>(state.range(0)), kind_of(state)));
}

/// 500 particles with breakage switched on; nothing breaks.
void engine_step_breakage(State &state, dem::BreakageParameters choice)
{
  choice.is_active = true;
  choice.fracture_energy = 1e12;
  step_engine(state,
              *benchmark_scenes::lattice(
                  500, benchmark_scenes::ParticleSystem::shapes, choice));
}

void sizes(benchmark::internal::Benchmark *kernel)
{
  kernel->ArgNames({"particles", "shapes"})
      ->ArgsProduct({{500, 5000}, {0, 1}})
      ->Unit(benchmark::kMicrosecond);
}
BENCHMARK(list_rebuild)->Apply(sizes);
BENCHMARK(engine_step)->Apply(sizes);

// The choices of the criterion, one by one.
BENCHMARK_CAPTURE(engine_step_breakage, default, {})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(engine_step_breakage, energy_with_shear,
                  {.energy = dem::CriterionEnergy::with_shear})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(engine_step_breakage, curvature_relative,
                  {.curvature = dem::CapCurvature::relative})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(engine_step_breakage, share_compliance,
                  {.share = dem::EnergyShare::compliance})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(engine_step_breakage, memory_patch,
                  {.memory = dem::FactorMemory::patch})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(engine_step_breakage, repetitions_10, {.repetitions = 10.})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(engine_step_breakage, hysteresis_0, {.hysteresis = 0.})
    ->Unit(benchmark::kMicrosecond);
} // namespace

BENCHMARK_MAIN();
