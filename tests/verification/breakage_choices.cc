// What the choices of the breakage model change, as
// docs/verification/breakage.md has it: one contact of two particles, and the
// small triaxial test.
//
//     breakage_choices SMALL.prm SHAPE.json [TABLE ...]
#include <dem/engine_boundaries.h>
#include <dem/measure/assembly.h>
#include <dem/shape/measures.h>

#include <algorithm>
#include <array>
#include <case/file.h>
#include <cstdio>
#include <iostream>
#include <random>
#include <shape/file.h>
#include <triaxial/triaxial.h>

namespace
{
using namespace spall;

/// Section Breakage of a case; empty: the defaults.
struct Choice
{
  const char *name;
  std::vector<Override> keys;
};

const std::vector<Choice> choices = {
    {"default", {}},
    {"energy = with_shear", {{"Breakage", "energy", "with_shear"}}},
    {"curvature = relative", {{"Breakage", "curvature", "relative"}}},
    {"share = compliance", {{"Breakage", "share", "compliance"}}},
    {"precedence = cumulative", {{"Breakage", "precedence", "cumulative"}}},
    {"sides = both", {{"Breakage", "sides", "both"}}},
    {"closure = article", {{"Breakage", "closure", "article"}}},
    {"kernel_scale = 2", {{"Breakage", "kernel_scale", "2"}}},
    {"kernel_floor = 4", {{"Breakage", "kernel_floor", "4"}}},
    {"curvature_floor_ratio = 5", {{"Breakage", "curvature_floor_ratio", "5"}}},
    {"curvature_floor_ratio = 20",
     {{"Breakage", "curvature_floor_ratio", "20"}}},
    {"hysteresis = 0", {{"Breakage", "hysteresis", "0"}}},
    {"memory = patch", {{"Breakage", "memory", "patch"}}},
    {"inscribed = free", {{"Breakage", "inscribed", "free"}}},
    {"contacts = all", {{"Breakage", "contacts", "all"}}},
    {"is_active = false", {{"Breakage", "is_active", "false"}}}};

Case case_with(const std::string &file, const std::vector<Override> &keys)
{
  return read_case(file, keys);
}

/// Sums over events.
struct Damage
{
  std::size_t n = 0, n_two = 0;
  double first = 0., volume = 0., released = 0., fracture = 0.;

  void add(const std::vector<dem::BreakageEvent> &events)
  {
    for (const dem::BreakageEvent &event : events)
    {
      first = n++ == 0 ? event.force_before : first;
      n_two += event.mode == dem::BreakageMode::instantaneous;
      volume += event.removed_volume;
      released += event.released_energy + event.kinetic_energy;
      fracture += event.fracture_energy;
    }
  }
};

/// Where the surface is sharpest, of many directions.
dem::Vec3 sharpest(const dem::ParticleShape &body)
{
  dem::Vec3 best;
  double largest = 0.;
  for (const dem::Vec3 &s : dem::standard_quadrature().direction)
  {
    const double gauss = dem::evaluate_side(body, s, 10.).curvature.gaussian();
    if (gauss > largest)
    {
      largest = gauss;
      best = s;
    }
  }
  return best;
}

/// Two particles of 20 mm, corner on corner, so heavy that their motion is
/// given: they come nearer by 1 mm at 0.2 m/s and slide past each other at 0.1
/// m/s.
void press(const Choice &choice, const std::string &file,
           const dem::ParticleShape &body)
{
  dem::EngineParameters p;
  p.breakage = case_with(file, choice.keys).breakage;
  p.breakage.fracture_energy = 1e4;
  p.particle.density = 1e9;
  dem::Engine engine(p);
  const dem::Vec3 corner = sharpest(body), x = dem::Vec3::UnitX();
  const double reach = dem::evaluate_side(body, corner, 10.).expansion.radius;
  for (const double side : {-1., 1.})
  {
    engine.add_particle(body, side * reach * x,
                        dem::Quaternion::FromTwoVectors(corner, -side * x));
    engine.particles().last().velocity = {-0.1 * side, 0.05 * side, 0.};
  }
  Damage damage;
  double peak = 0.;
  while (engine.time() < 5e-3)
  {
    engine.advance(1e-6);
    peak = std::max(peak, engine.particles().load[0].force.norm());
    damage.add(engine.take_events());
  }
  std::printf("| %s | %.0f | %.0f | %zu | %zu | %.3g | %.3g | %.3g |\n",
              choice.name, damage.first, peak, damage.n, damage.n_two,
              1e9 * damage.volume, 1e3 * damage.released,
              1e3 * damage.fracture);
}

void run_small(const Choice &choice, const std::string &file)
{
  Triaxial test(case_with(file, choice.keys));
  Damage damage;
  while (test.stage() != Stage::done)
  {
    test.advance();
    damage.add(test.take_events());
  }
  test.engine().synchronize();
  const Sample end = test.sample(0.);
  std::printf("| %s | %zu | %zu | %.4f | %.3g | %.3g | %.2f | %.2f |\n",
              choice.name, damage.n, damage.n_two, end.laa,
              1e3 * damage.released, 1e3 * damage.fracture,
              100. * end.axial_strain, end.coordination_number);
  std::fflush(stdout);
}

std::vector<const dem::ContactBatch *> batches(const dem::Engine &engine)
{
  std::vector<const dem::ContactBatch *> all{&engine.pairs(),
                                             &dem::on_planes(engine)};
  for (const dem::FacetBoundary &facets : dem::surfaces(engine))
    all.push_back(&facets.batch);
  return all;
}

/// Sum of the cumulative factors of all contacts.
double factors(const dem::Engine &engine)
{
  double sum = 0.;
  for (const dem::ContactBatch *batch : batches(engine))
    for (const auto *column : {&batch->factor_a, &batch->factor_b})
      for (std::size_t k = 0; k < std::min(batch->size(), column->size()); ++k)
        sum += (*column)[k];
  return sum;
}

/// Sides that gather damage: corners in contact.
double n_at_risk(const dem::Engine &engine)
{
  int n = 0;
  for (const dem::ContactBatch *batch : batches(engine))
    for (const auto *column : {&batch->corner_a, &batch->corner_b})
      for (std::size_t k = 0; k < std::min(batch->size(), column->size()); ++k)
        n += (*column)[k] > 0.f && batch->is_touching(k);
  return n;
}

/// Sums up what the cumulative factors gain, step by step; what contacts lose
/// as they open, or in a step that makes the lists anew, does not count.
class Gains
{
public:
  double total = 0.;

  void look(const dem::Engine &engine)
  {
    std::size_t column_index = 0;
    for (const dem::ContactBatch *batch :
         {&engine.pairs(), &dem::on_planes(engine), &dem::on_facets(engine)})
    {
      gather(*batch, batch->factor_a, column_index++);
      gather(*batch, batch->factor_b, column_index++);
    }
  }

private:
  struct Column
  {
    std::vector<std::int32_t> a, b;
    std::vector<double> factor;
  };

  void gather(const dem::ContactBatch &batch, const std::vector<double> &factor,
              std::size_t column_index)
  {
    Column &old = before[column_index];
    if (old.a == batch.a && old.b == batch.b)
      for (std::size_t k = 0; k < std::min(batch.size(), factor.size()); ++k)
        total += std::max(0., factor[k] - old.factor[k]);
    old = {batch.a, batch.b, factor};
  }

  std::array<Column, 6> before;
};

/// Load cycles whose gains count.
struct Span
{
  const char *amplitude; ///< [Pa]
  int first = 0, last = 0;
};

/// Gains per second and corner in contact of a specimen in the membrane whose
/// particles are too strong to break: its path is that of every band. In units
/// of the fracture energy of the case.
double gain_rate(const std::string &file, const Span &cycles,
                 const std::string &hysteresis)
{
  constexpr double strength = 1e6;
  const std::vector<Override> keys = {
      {"Loading", "amplitude", cycles.amplitude},
      {"Loading", "cycles", std::to_string(cycles.last)},
      {"Breakage", "hysteresis", hysteresis},
      {"Breakage", "fracture_energy", std::to_string(strength)}};
  Triaxial test(case_with(file, keys));
  while (test.stage() != Stage::loading || test.cycle() < cycles.first)
    test.advance();
  Gains gains;
  double seconds_at_risk = 0.;
  while (test.stage() != Stage::done)
  {
    const double time = test.engine().time();
    test.advance();
    test.engine().synchronize();
    gains.look(test.engine());
    seconds_at_risk += (test.engine().time() - time) * n_at_risk(test.engine());
  }
  return gains.total / seconds_at_risk * strength /
         case_with(file, {}).breakage.fracture_energy;
}

/// What a band takes from rest and from load cycles.
void band_table(const std::string &file)
{
  std::printf("\n| hysteresis | at rest | in load cycles | of that with 0 |\n"
              "|---|---|---|---|\n");
  double all = 0.;
  for (const char *band : {"0", "0.01", "0.02", "0.05", "0.1", "0.2"})
  {
    const double at_rest = gain_rate(file, {"0", 16, 20}, band),
                 loaded = gain_rate(file, {"100e3", 2, 6}, band);
    all = all > 0. ? all : loaded;
    std::printf("| %s | %.2g | %.4g | %.4f |\n", band, at_rest, loaded,
                loaded / all);
    std::fflush(stdout);
  }
}

/// A specimen that only rests, with the names of its keys. Balls gather damage
/// only where all contacts do.
struct Rest
{
  const char *geometry, *walls, *contacts, *lateral, *damping, *hysteresis;
};

/// Its damage per second and side at risk in each fifth of 200 ms.
void rest(const Rest &keys, const std::string &file)
{
  std::vector<Override> overrides = {
      {"Contact", "geometry", keys.geometry},
      {"Contact", "wall_geometry", keys.walls},
      {"Breakage", "contacts", keys.contacts},
      {"Boundary", "lateral", keys.lateral},
      {"Coupling", "exchange", "every_step"},
      {"Loading", "amplitude", "0"},
      {"Loading", "cycles", "20"},
      {"Time", "local_damping", keys.damping},
      {"Breakage", "hysteresis", keys.hysteresis}};
  // True surfaces need more room than balls and no rolling resistance.
  if (std::string(keys.geometry) == "surface")
    overrides.insert(overrides.end(),
                     {{"Specimen", "initial_solid_fraction", "0.12"},
                      {"Particle", "rolling_friction", "0"},
                      {"Time", "fixed_step", "7e-7"}});
  Triaxial test(case_with(file, overrides));
  while (test.stage() != Stage::loading)
    test.advance();
  test.engine().synchronize();
  test.take_events();
  std::printf("| %s | %s | %s | %s |", keys.geometry, keys.lateral,
              keys.damping, keys.hysteresis);
  double before = factors(test.engine()), time = test.engine().time();
  double kinetic = 0.;
  for (int part = 1; test.stage() != Stage::done; ++part)
  {
    Damage damage;
    while (test.stage() != Stage::done && test.cycle() < 4 * part)
    {
      test.advance();
      damage.add(test.take_events());
    }
    test.engine().synchronize();
    const double now =
        factors(test.engine()) + static_cast<double>(damage.n - damage.n_two);
    const double seconds = test.engine().time() - time;
    std::printf(" %.2g |", (now - before) / seconds / n_at_risk(test.engine()));
    before = factors(test.engine());
    time = test.engine().time();
    kinetic = test.engine().energy().kinetic;
  }
  std::printf(" %.1g |\n", kinetic);
  std::fflush(stdout);
}

void contact_table(const std::string &file, const dem::ParticleShape &body)
{
  std::printf("| choice | first event (N) | largest force (N) | events | mode "
              "II | volume (mm^3) | released (mJ) | G_c A_i (mJ) |\n"
              "|---|---|---|---|---|---|---|---|\n");
  for (const Choice &choice : choices)
    press(choice, file, body);
}

void specimen_table(const std::string &file)
{
  std::printf("\n| choice | events | mode II | LAA (%%) | released (mJ) | G_c "
              "A_i (mJ) | permanent strain (%%) | coordination |\n"
              "|---|---|---|---|---|---|---|---|\n");
  for (const Choice &choice : choices)
    run_small(choice, file);
}

void rest_table(const std::string &file)
{
  std::printf("\n| geometry | sides | D_a | hysteresis | 0 to 40 ms | to 80 | "
              "to 120 | to 160 | to 200 | kinetic energy (J) |\n"
              "|---|---|---|---|---|---|---|---|---|---|\n");
  for (const char *hysteresis : {"0", "0.01"})
    for (const Rest &keys :
         {Rest{"surface", "surface", "seen", "rigid", "0.5", hysteresis},
          Rest{"surface", "surface", "seen", "membrane", "0.5", hysteresis},
          Rest{"radial", "sphere", "seen", "rigid", "0.5", hysteresis},
          Rest{"radial", "sphere", "seen", "rigid", "0", hysteresis},
          Rest{"radial", "sphere", "seen", "membrane", "0.5", hysteresis},
          Rest{"sphere", "sphere", "all", "rigid", "0.5", hysteresis},
          Rest{"sphere", "sphere", "all", "membrane", "0.5", hysteresis}})
      rest(keys, file);
}
} // namespace

int main(int argc, char **argv)
{
  if (argc < 3)
  {
    std::cerr << "usage: breakage_choices SMALL.prm SHAPE.json [TABLE ...]\n"
                 "tables: contact specimen rest bands; all by default\n";
    return 1;
  }
  const std::string file = argv[1];
  const std::vector<std::string> tables(argv + 3, argv + argc);
  const auto is_asked = [&tables](const char *table)
  {
    return tables.empty() ||
           std::find(tables.begin(), tables.end(), table) != tables.end();
  };
  if (is_asked("contact"))
    contact_table(file,
                  dem::make_shape(std::make_shared<const dem::Coefficients>(
                                      read_shape(argv[2]).coefficients),
                                  0.01));
  if (is_asked("specimen"))
    specimen_table(file);
  if (is_asked("rest"))
    rest_table(file);
  if (is_asked("bands"))
    band_table(file);
  return 0;
}
