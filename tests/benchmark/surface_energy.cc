// Where the energy of undamped true surfaces goes: the table of
// docs/verification/surface_energy.md.
//
//   surface_energy N_IMPACTS SEED
//   surface_energy box N_STEPS SEED
//
// Two particles of one shape meet without friction and damping; what their
// normal springs gain or lose without work is split, step by step, into the
// change of C_H, the renewal of the expansions and the rest.
#include "dem_scene.h"

#include <dem/contact/laws/hertz.h>
#include <dem/engine_boundaries.h>
#include <dem/random.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <shape/test_shapes.h>
#include <string>
#include <vector>

namespace
{
using dem::Vec3;

constexpr double mean_radius = 0.01; ///< [m]

/// One loaded contact as a step left it.
struct Loaded
{
  std::int32_t a = 0, b = 0;
  Vec3 on_a = Vec3::Zero(); ///< direction of the contact in A
  Vec3 expanded_a = Vec3::Zero(), expanded_b = Vec3::Zero(); ///< directions
  double prefactor = 0.; ///< C_H [N/m^(3/2)]
  double overlap = 0.;   ///< [m]
};

/// Energy that left the normal springs without work [J].
struct Parts
{
  double stiffness = 0.; ///< C_H changed at constant overlap
  double renewal = 0.;   ///< overlap jumped where an expansion was renewed
  double search = 0.;    ///< contacts jumped, ended, began late or merged
  double tracking = 0.;  ///< overlap changed by other than the motion
  double scheme = 0.;    ///< trapezoidal work less the energy of the spring
  double sum() const
  {
    return stiffness + renewal + search + tracking + scheme;
  }
};

Vec3 vector_of(const dem::Triple<double> &v)
{
  return {v.x, v.y, v.z};
}

std::vector<Loaded> loaded_contacts(const dem::Engine &engine)
{
  const dem::ContactBatch &pairs = engine.pairs();
  std::vector<Loaded> contacts;
  for (std::size_t k = 0; k < pairs.size(); ++k)
    if (pairs.is_touching(k))
      contacts.push_back({pairs.a[k], pairs.b[k], pairs.side_a.contact_point(k),
                          vector_of(pairs.side_a.direction[k]),
                          vector_of(pairs.side_b.direction[k]),
                          pairs.normal_prefactor[k], pairs.overlap[k]});
  return contacts;
}

/// The same contact before the step: the nearest on the surface of A.
const Loaded *before_step(const std::vector<Loaded> &contacts,
                          const Loaded &now)
{
  const Loaded *nearest = nullptr;
  double least = 0.1; // [rad]
  for (const Loaded &one : contacts)
    if (const double d = (one.on_a - now.on_a).norm();
        one.a == now.a && one.b == now.b && d < least)
    {
      least = d;
      nearest = &one;
    }
  return nearest;
}

double power(double overlap, double exponent)
{
  return overlap > 0. ? std::pow(overlap, exponent) : 0.;
}

/// Splits the change of shape work of one step. The energy 2/5 C delta^(5/2)
/// changes by the mean C times the change of the power (the work, but for the
/// error of the trapezoid), and by the change of C times its mean.
class Splitter
{
public:
  explicit Splitter(const dem::Engine &engine) { look(engine); }

  void add_step(const dem::Engine &engine)
  {
    const std::vector<Loaded> last = contacts;
    const double last_work = shape_work;
    const std::int64_t last_events = events;
    look(engine);
    Parts step;
    bool is_renewed_now = false;
    for (const Loaded &now : contacts)
    {
      const Loaded *before = before_step(last, now);
      Loaded begin = now;
      begin.overlap = 0.;
      add_contact(before ? *before : begin, now, step);
      is_renewed_now =
          is_renewed_now || (before && (before->expanded_a != now.expanded_a ||
                                        before->expanded_b != now.expanded_b));
    }
    for (const Loaded &old : last)
      if (!before_step(contacts, old))
      {
        Loaded open = old;
        open.overlap = 0.;
        add_contact(old, open, step);
      }
    const double rest = shape_work - last_work - step.stiffness - step.scheme;
    (events != last_events          ? parts.search
     : is_renewed || is_renewed_now ? parts.renewal
                                    : parts.tracking) += rest;
    is_renewed = is_renewed_now;
    n_begun += static_cast<int>(std::count_if(
        contacts.begin(), contacts.end(),
        [&last](const Loaded &now) { return !before_step(last, now); }));
    parts.stiffness += step.stiffness;
    parts.scheme += step.scheme;
  }

  Parts parts;
  int n_begun = 0; ///< contacts that began

private:
  void look(const dem::Engine &engine)
  {
    contacts = loaded_contacts(engine);
    shape_work = engine.energy().non_conservative_work;
    const dem::ContactPointEvents &e = engine.contact_point_events();
    events = e.n_late + e.n_jumps + e.n_ended + e.n_merged;
  }

  static void add_contact(const Loaded &old, const Loaded &now, Parts &step)
  {
    const double mean = 0.5 * (old.prefactor + now.prefactor);
    const double energy_old = power(old.overlap, 2.5),
                 energy_now = power(now.overlap, 2.5);
    step.stiffness -= dem::hertz_energy_share *
                      (now.prefactor - old.prefactor) * 0.5 *
                      (energy_old + energy_now);
    step.scheme +=
        mean * (0.5 * (power(old.overlap, 1.5) + power(now.overlap, 1.5)) *
                    (now.overlap - old.overlap) -
                dem::hertz_energy_share * (energy_now - energy_old));
  }

  std::vector<Loaded> contacts;
  double shape_work = 0.;
  std::int64_t events = 0;
  bool is_renewed = false; ///< an expansion, which the next step uses
};

std::vector<double> series_of(const std::string &shape, unsigned seed)
{
  if (shape == "ellipsoid")
    return dem::test::project(
        16,
        [](const Vec3 &s) {
          return dem::test::ellipsoid_radius({0.012, 0.01, 0.008}, s);
        });
  if (shape == "cube")
    return dem::test::project(
        16, [](const Vec3 &s)
        { return mean_radius * std::pow(s.array().pow(4.).sum(), -0.25); });
  return dem::test::random_particle(14, seed);
}

/// One way to run all impacts.
struct Setting
{
  std::string shape;
  double tolerance = 5e-3; ///< Contact/refresh_tolerance [rad]
  double step = 1e-6;      ///< [s]
};

/// Splits one impact at 1 m/s with random turns; parts over the energy that
/// the approach has. False: they have not met.
bool run_impact(const Setting &setting,
                const std::shared_ptr<const dem::Coefficients> &series,
                unsigned seed, Parts &parts)
{
  dem::EngineParameters p = support::bare_parameters();
  p.geometry.geometry = p.geometry.wall_geometry =
      dem::ContactGeometry::surface;
  p.geometry.refresh_tolerance = setting.tolerance;
  p.geometry.usual_skin = 3e-4;
  dem::Engine engine(p);
  dem::Random random(seed);
  const dem::ParticleShape body = dem::make_shape(series, mean_radius);
  const double reach = body.circumscribed_radius;
  engine.add_particle(body, Vec3::Zero(), random.rotation());
  engine.add_particle(body,
                      {reach * (random.uniform() - 0.5),
                       reach * (random.uniform() - 0.5), 2. * reach},
                      random.rotation());
  engine.particles().velocity(1) = {0., 0., -1.};
  for (const std::size_t i : {0u, 1u})
    for (int d = 0; d < 3; ++d)
      engine.particles().spin(i)[d] = 100. * (random.uniform() - 0.5);
  const double start = 0.25 * engine.particles().mass(0);
  Splitter splitter(engine);
  bool has_met = false;
  // Until they are apart for a millisecond, 20 ms at most.
  int n_open = 0;
  const int n_most = static_cast<int>(0.02 / setting.step);
  for (int step = 0; step < n_most && n_open * setting.step < 1e-3; ++step)
  {
    engine.advance(setting.step);
    splitter.add_step(engine);
    const bool is_open = engine.energy().elastic <= 0.;
    has_met = has_met || !is_open;
    n_open = has_met && is_open ? n_open + 1 : 0;
  }
  parts = splitter.parts;
  for (double *part : {&parts.stiffness, &parts.renewal, &parts.search,
                       &parts.tracking, &parts.scheme})
    *part /= start;
  return has_met;
}

/// Mean and root mean square of one part over all impacts, in 1e-4.
void print_part(const std::vector<Parts> &all, double (*part)(const Parts &))
{
  double mean = 0., square = 0.;
  for (const Parts &one : all)
  {
    mean += part(one);
    square += part(one) * part(one);
  }
  const auto n = static_cast<double>(all.size());
  std::printf(" %.2f (%.2f) |", 1e4 * mean / n, 1e4 * std::sqrt(square / n));
}

void print_row(const Setting &setting, int n_impacts, unsigned seed)
{
  std::vector<Parts> all;
  for (unsigned k = 0; static_cast<int>(k) < n_impacts; ++k)
  {
    static std::string last_shape;
    static std::shared_ptr<const dem::Coefficients> series;
    if (setting.shape != last_shape || setting.shape == "rough")
      series = std::make_shared<const dem::Coefficients>(
          series_of(setting.shape, seed + k % 10));
    last_shape = setting.shape;
    Parts parts;
    if (run_impact(setting, series, seed + k, parts))
      all.push_back(parts);
  }
  std::printf("| %s | %g | %g | %zu |", setting.shape.c_str(),
              setting.tolerance, 1e6 * setting.step, all.size());
  print_part(all, [](const Parts &p) { return p.sum(); });
  print_part(all, [](const Parts &p) { return p.stiffness; });
  print_part(all, [](const Parts &p) { return p.renewal; });
  print_part(all, [](const Parts &p) { return p.search; });
  print_part(all, [](const Parts &p) { return p.tracking; });
  print_part(all, [](const Parts &p) { return p.scheme; });
  std::printf("\n");
  std::fflush(stdout);
}

/// 64 particles that fly in a box of linear walls at 1 m/s; the parts over the
/// first energy, in per cent.
void print_box(const Setting &setting, int n_steps, unsigned seed)
{
  dem::EngineParameters p = support::bare_parameters();
  p.geometry.geometry = p.geometry.wall_geometry =
      dem::ContactGeometry::surface;
  p.geometry.refresh_tolerance = setting.tolerance;
  p.wall.normal_stiffness = 1e6;
  p.geometry.usual_skin = 1e-3;
  dem::Engine engine(p);
  dem::Random random(seed);
  constexpr double pitch = 0.03;
  for (int d = 0; d < 3; ++d)
  {
    dem::add_plane(engine, Vec3::Zero(), Vec3::Unit(d));
    dem::add_plane(engine, 4. * pitch * Vec3::Unit(d), -Vec3::Unit(d));
  }
  const auto series =
      std::make_shared<const dem::Coefficients>(series_of(setting.shape, seed));
  for (int i = 0; i < 64; ++i)
  {
    const Vec3 cell(i % 4 + 0.5, i / 4 % 4 + 0.5, i / 16 + 0.5);
    engine.add_particle(dem::make_shape(series, mean_radius), pitch * cell,
                        random.rotation());
    engine.particles().last().velocity = random.rotation() * Vec3::UnitX();
  }
  const double start = engine.energy().kinetic;
  Splitter splitter(engine);
  for (int step = 0; step < n_steps; ++step)
  {
    engine.advance(setting.step);
    splitter.add_step(engine);
  }
  const dem::EngineEnergy energy = engine.energy();
  const Parts &parts = splitter.parts;
  std::printf("| %s | %g | %g | %d | %d | %.3f |", setting.shape.c_str(),
              setting.tolerance, 1e6 * setting.step, n_steps, splitter.n_begun,
              100. * ((energy.kinetic + energy.elastic) / start - 1.));
  for (const double part : {parts.sum(), parts.stiffness, parts.renewal,
                            parts.search, parts.tracking, parts.scheme})
    std::printf(" %.3f |", 100. * part / start);
  std::printf("\n");
  std::fflush(stdout);
}

void print_boxes(int n_steps, unsigned seed)
{
  std::printf("| shape | tolerance [rad] | step [us] | steps | contacts begun "
              "| energy | shape work | C_H | renewal | search | tracking | "
              "scheme |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const char *shape : {"ellipsoid", "cube", "rough"})
    for (const double tolerance : {5e-3, 1e-3})
      print_box({shape, tolerance, 1e-6}, n_steps, seed);
}
} // namespace

int main(int argc, char **argv)
{
  if (argc == 4 && std::string(argv[1]) == "box")
  {
    print_boxes(std::atoi(argv[2]), static_cast<unsigned>(std::atoi(argv[3])));
    return 0;
  }
  if (argc != 3)
  {
    std::fprintf(stderr, "surface_energy N_IMPACTS SEED\n"
                         "surface_energy box N_STEPS SEED\n");
    return 1;
  }
  std::printf("| shape | tolerance [rad] | step [us] | impacts | all | C_H | "
              "renewal | search | tracking | scheme |\n"
              "|---|---|---|---|---|---|---|---|---|---|\n");
  const auto seed = static_cast<unsigned>(std::atoi(argv[2]));
  for (const char *shape : {"ellipsoid", "cube", "rough"})
    for (const Setting &setting :
         {Setting{shape, 5e-3, 1e-6}, Setting{shape, 2e-2, 1e-6},
          Setting{shape, 1e-3, 1e-6}, Setting{shape, 5e-3, 5e-7}})
      print_row(setting, std::atoi(argv[1]), seed);
}
