// What the ways to say where two particles meet cost, and what they miss:
// tables and figures of docs/results/geometry_cost.md.
//
//   geometry_cost PAIRS PICTURES TABLE.csv SHAPE.json [SHAPE.json ...]
#include "bench/measure.h"
#include "brute_force.h"
#include "geometry_methods.h"
#include "report/chart.h"

#include <dem/random.h>

#include <cstdio>
#include <fstream>
#include <functional>
#include <map>
#include <omp.h>
#include <shape/file.h>
#include <string>

namespace
{
using dem::ParticleShape;
using dem::Vec3;
using spall::Meeting;
using support::processor_time;

constexpr double equivalent_radius = 0.01; ///< [m]
constexpr double diameter = 2. * equivalent_radius;

/// Errors of many meetings, as sums of squares.
struct Errors
{
  double gap = 0., angle = 0., arm = 0.;
  int n = 0, n_lost = 0;

  /// Gap over the diameter, normal [deg], lever arm over the ball radius.
  void add(const Meeting &found, const Meeting &exact)
  {
    if (!found.is_found)
    {
      ++n_lost;
      return;
    }
    ++n;
    gap += std::pow((found.overlap - exact.overlap) / diameter, 2);
    const double turn = std::atan2(found.normal.cross(exact.normal).norm(),
                                   found.normal.dot(exact.normal));
    angle += std::pow(turn * 180. / std::numbers::pi, 2);
    const Vec3 lever = found.arm.cross(found.normal),
               right = exact.arm.cross(exact.normal);
    arm += std::pow((lever - right).norm() / equivalent_radius, 2);
  }
  double of(double Errors::*sum) const
  {
    return std::sqrt(this->*sum / std::max(1, n));
  }
  Errors &operator+=(const Errors &more)
  {
    gap += more.gap;
    angle += more.angle;
    arm += more.arm;
    n += more.n;
    n_lost += more.n_lost;
    return *this;
  }
};

struct Row
{
  std::string method;
  double nanoseconds = 0.; ///< per contact and step
  Errors errors;           ///< beside the true contact
  Errors cache;            ///< beside the same geometry without a cache
};

/// Pairs of one shape that just touch.
struct Pairs
{
  ParticleShape body;
  dem::RadiusMap map;
  std::vector<dem::RelativePose> poses;
  std::vector<Meeting> exact;
  std::vector<dem::ContactPoint> contact_points;
  int n_left_out = 0; ///< pairs without a lens of contact: flat on flat

  Pairs(const dem::Coefficients &series, int n_pairs)
      : body(dem::make_shape(std::make_shared<const dem::Coefficients>(series),
                             equivalent_radius)),
        map(body.series)
  {
    dem::Random random(1);
    while (static_cast<int>(poses.size()) < n_pairs)
    {
      const Vec3 along = random.rotation() * Vec3::UnitX();
      const auto pair =
          spall::bring_together(at({2. * body.circumscribed_radius * along,
                                    random.rotation().toRotationMatrix()}));
      const dem::ContactPoint contact_point =
          pair ? spall::deepest_contact_point(*pair, 0.01 * diameter)
               : dem::ContactPoint{};
      if (!contact_point.is_found)
      {
        ++n_left_out;
        continue;
      }
      poses.push_back(pair->pose);
      contact_points.push_back(contact_point);
      exact.push_back(spall::by_refinement(*pair, contact_point));
    }
  }
  dem::MappedPair at(const dem::RelativePose &pose) const
  {
    return {{body, map}, {body, map}, pose};
  }
};

/// A method that evaluates the series each time, on top of `base` ns for all
/// that a step does with a contact besides.
Row time_alone(
    const Pairs &pairs, const std::string &name, double base,
    const std::function<Meeting(const dem::MappedPair &, std::size_t)> &method)
{
  Row row{name, 0., {}, {}};
  std::vector<Meeting> found(pairs.poses.size());
  const double begun = processor_time();
  int n = 0;
  do
  {
    for (std::size_t k = 0; k < found.size(); ++k)
      found[k] = method(pairs.at(pairs.poses[k]), k);
    n += static_cast<int>(found.size());
  } while (processor_time() - begun < 0.1);
  row.nanoseconds = base + 1e9 * (processor_time() - begun) / n;
  for (std::size_t k = 0; k < found.size(); ++k)
    row.errors.add(found[k], pairs.exact[k]);
  return row;
}

/// The engine with each pair far from all others, turning at 4 rad/s, in
/// contacts too soft to move it; `p` has the law. The distances are such that
/// pairs overlap by 0.2 % of the diameter in the geometry of the engine.
dem::Engine turning_pairs(const Pairs &pairs, dem::EngineParameters p,
                          dem::ContactGeometry geometry, double tolerance)
{
  p.particle.shear_modulus = 1e-3;
  p.breakage.is_active = false;
  p.geometry.geometry = geometry;
  p.geometry.refresh_tolerance = tolerance;
  dem::Engine engine(p);
  dem::Random random(2);
  const double room = 6. * pairs.body.circumscribed_radius;
  for (std::size_t k = 0; k < pairs.poses.size(); ++k)
  {
    const dem::MappedPair pair = pairs.at(pairs.poses[k]);
    const double overlap = geometry == dem::ContactGeometry::sphere
                               ? spall::by_balls(pair).overlap
                           : geometry == dem::ContactGeometry::radial
                               ? spall::by_radii(pair).overlap
                               : pairs.exact[k].overlap;
    const Vec3 here(room * static_cast<double>(k % 16),
                    room * static_cast<double>(k / 16), 0.),
        branch = pair.pose.position * (1. + (overlap - 0.002 * diameter) /
                                                pair.pose.position.norm());
    engine.add_particle(pairs.body, here, dem::Quaternion::Identity());
    engine.add_particle(pairs.body, here + branch,
                        dem::Quaternion(pair.pose.rotation));
  }
  for (std::size_t k = 0; k < engine.particles().size(); ++k)
    engine.particles().spin(k) = 4. * (random.rotation() * Vec3::UnitX());
  return engine;
}

/// Where the engine has a pair meet, from the exact series: its geometry.
Meeting exactly(const Pairs &pairs, const dem::Engine &engine, std::size_t c)
{
  const dem::ParticleSystem &particles = engine.particles();
  const auto a = static_cast<std::size_t>(engine.pairs().a[c]),
             b = static_cast<std::size_t>(engine.pairs().b[c]);
  const dem::Mat3 into_a = particles.rotation(a).transpose();
  const dem::MappedPair pair =
      pairs.at({into_a * (particles.position(b) - particles.position(a)),
                into_a * particles.rotation(b)});
  switch (engine.parameters().geometry.geometry)
  {
  case dem::ContactGeometry::sphere:
    return spall::by_balls(pair);
  case dem::ContactGeometry::radial:
    return spall::by_radii(pair);
  case dem::ContactGeometry::surface:
    return spall::by_search(pair, 0.01 * diameter);
  }
  return {};
}

/// Of the contact points where two particles touch, the deepest, and how many
/// there are; particle A is in no other pair.
struct Touch
{
  std::size_t deepest = 0;
  int n = 0;
};

std::map<std::int32_t, Touch> touches(const dem::ContactBatch &batch)
{
  std::map<std::int32_t, Touch> of;
  for (std::size_t c = 0; c < batch.size(); ++c)
    if (batch.is_touching(c))
    {
      Touch &touch = of[batch.a[c]];
      if (touch.n++ == 0 || batch.overlap[c] > batch.overlap[touch.deepest])
        touch.deepest = c;
    }
  return of;
}

/// Where the engine has two particles that touch once meet: normal and lever
/// arm from the force and the moment that act on A, springs alone.
Meeting by_engine(const dem::Engine &engine, std::size_t c)
{
  const auto a = static_cast<std::size_t>(engine.pairs().a[c]);
  const dem::ParticleLoad &load = engine.particles().load[a];
  const dem::Mat3 into_a = engine.particles().rotation(a).transpose();
  const double force = load.force.norm();
  Meeting meeting;
  meeting.overlap = engine.pairs().overlap[c];
  meeting.normal = -(into_a * load.force) / force;
  // arm x normal = -moment / force.
  meeting.arm = meeting.normal.cross(-(into_a * load.moment) / force);
  return meeting;
}

constexpr int n_steps = 5000; ///< of 1e-6 s

/// What the cache of the engine is wrong by after all steps.
Errors cache_errors(const Pairs &pairs, dem::ContactGeometry geometry,
                    double tolerance)
{
  dem::EngineParameters springs;
  springs.particle.friction = springs.particle.rolling_friction = 0.;
  springs.particle.normal_damping = springs.particle.shear_damping = 0.;
  dem::Engine engine = turning_pairs(pairs, springs, geometry, tolerance);
  for (int step = 0; step < n_steps; ++step)
    engine.advance(1e-6);
  Errors errors;
  for (const auto &[particle, touch] : touches(engine.pairs()))
  {
    const Meeting exact = exactly(pairs, engine, touch.deepest);
    const double overlap = engine.pairs().overlap[touch.deepest];
    // Beyond what any cache may be wrong by, it is another contact point.
    if (std::abs(overlap - exact.overlap) > 1e-4 * diameter)
      ++errors.n_lost;
    else if (touch.n == 1)
      errors.add(by_engine(engine, touch.deepest), exact);
  }
  return errors;
}

/// Contacts of the engine with the default law: their time, and the error of
/// the cache.
Row time_engine(const Pairs &pairs, const std::string &name,
                dem::ContactGeometry geometry, double tolerance)
{
  dem::Engine engine = turning_pairs(pairs, {}, geometry, tolerance);
  spall::measure(engine, 200, 1e-6);
  const spall::BenchSample sample = spall::measure(engine, n_steps, 1e-6);
  const dem::EngineClock &p = sample.phases;
  const double share =
      (p.contacts + p.search) / (p.contacts + p.search + p.breakage + p.motion);
  return {name,
          1e9 * sample.cpu * share / sample.updates(),
          {},
          cache_errors(pairs, geometry, tolerance)};
}

/// What a way of the engine has for errors: those of the geometry, and those
/// of the cache.
Row with_cache(const Row &geometry, const Row &cached)
{
  Row row = cached;
  row.errors = geometry.errors;
  row.errors.n_lost = cached.cache.n_lost;
  for (double Errors::*sum : {&Errors::gap, &Errors::angle, &Errors::arm})
    row.errors.*sum += row.errors.n * std::pow(cached.cache.of(sum), 2);
  return row;
}

std::vector<Row> measure_all(const Pairs &pairs)
{
  using Geometry = dem::ContactGeometry;
  const Row ball = time_engine(pairs, "sphere", Geometry::sphere, 5e-3);
  const auto alone = [&](const std::string &name, const auto &method)
  { return time_alone(pairs, name, ball.nanoseconds, method); };
  std::vector<Row> rows;
  rows.push_back(with_cache(alone("", [](const auto &pair, std::size_t)
                                  { return spall::by_balls(pair); }),
                            ball));
  const Row radii = alone("", [](const auto &pair, std::size_t)
                          { return spall::by_radii(pair); }),
            refine = alone("",
                           [&](const auto &pair, std::size_t k) {
                             return spall::by_refinement(
                                 pair, pairs.contact_points[k]);
                           });
  const std::array<std::pair<const char *, double>, 4> tolerances = {
      {{"each step", 0.}, {"1e-3", 1e-3}, {"5e-3", 5e-3}, {"2e-2", 2e-2}}};
  for (const auto &[text, value] : tolerances)
    rows.push_back(
        with_cache(radii, time_engine(pairs, std::string("radial, ") + text,
                                      Geometry::radial, value)));
  for (int n = 1; n <= 3; ++n)
    rows.push_back(alone("radial, corrected " + std::to_string(n),
                         [n](const auto &pair, std::size_t)
                         { return spall::by_heights(pair, n); }));
  for (const auto &[text, value] : tolerances)
    rows.push_back(
        with_cache(refine, time_engine(pairs, std::string("surface, ") + text,
                                       Geometry::surface, value)));
  rows.push_back(alone("surface, searched", [](const auto &pair, std::size_t)
                       { return spall::by_search(pair, 0.01 * diameter); }));
  return rows;
}

/// The rows of all shapes of one order, way by way.
using ByOrder = std::map<int, std::vector<std::vector<Row>>>;

/// One way over all shapes: mean time, sums of errors.
Row over_shapes(const std::vector<std::vector<Row>> &shapes, std::size_t way)
{
  Row sum = shapes.front()[way];
  for (std::size_t k = 1; k < shapes.size(); ++k)
  {
    sum.nanoseconds += shapes[k][way].nanoseconds;
    sum.errors += shapes[k][way].errors;
    sum.cache += shapes[k][way].cache;
  }
  sum.nanoseconds /= static_cast<double>(shapes.size());
  return sum;
}

void print_errors(const Row &row)
{
  std::printf("%.0f | %.1e | %.1e | %.1e | %d |\n", row.nanoseconds,
              row.errors.of(&Errors::gap), row.errors.of(&Errors::angle),
              row.errors.of(&Errors::arm), row.errors.n_lost);
}

/// All ways at every order, comma-separated.
void write_ways(const ByOrder &all, const std::string &path)
{
  std::ofstream out(path);
  out << "order,way,ns per contact and step,gap error / diameter,"
         "normal (deg),lever arm / radius,lost\n";
  for (const auto &[order, shapes] : all)
    for (std::size_t way = 0; way < shapes.front().size(); ++way)
    {
      const Row row = over_shapes(shapes, way);
      char text[160];
      std::snprintf(text, sizeof text, "%d,\"%s\",%.0f,%.1e,%.1e,%.1e,%d\n",
                    order, row.method.c_str(), row.nanoseconds,
                    row.errors.of(&Errors::gap), row.errors.of(&Errors::angle),
                    row.errors.of(&Errors::arm), row.errors.n_lost);
      out << text;
    }
}

/// What the tolerance of the cache costs and saves, over all orders.
void print_cache(const ByOrder &all)
{
  std::printf("| way | ns per contact and step | error of the cache: gap / "
              "diameter | normal [deg] | lever arm / radius | lost |\n"
              "|---|---|---|---|---|---|\n");
  std::vector<std::vector<Row>> every;
  for (const auto &[order, shapes] : all)
    every.insert(every.end(), shapes.begin(), shapes.end());
  for (std::size_t way = 0; way < every.front().size(); ++way)
  {
    Row row = over_shapes(every, way);
    if (row.cache.n == 0)
      continue;
    row.errors = row.cache;
    std::printf("| %s | ", row.method.c_str());
    print_errors(row);
  }
}

/// Smaller errors are drawn as this.
constexpr double smallest_shown = 1e-10;

/// All rows as points of one error over time, a colour for each way.
spall::Chart chart_of(const std::string &id, const std::string &y_label,
                      double Errors::*error, const std::vector<Row> &rows)
{
  spall::Chart chart;
  chart.id = id;
  chart.caption = "Error against time per contact and step.";
  chart.x_label = "Time per contact and step (ns)";
  chart.y_label = y_label;
  chart.has_log_x = chart.has_log_y = true;
  for (const std::string way :
       {"sphere", "radial, each step", "radial, 5e-3", "radial, corrected",
        "surface, each step", "surface, 5e-3", "surface, searched"})
  {
    spall::Curve curve;
    curve.name = way;
    curve.colour = spall::palette_colour(chart.curves.size());
    curve.line_width = 0.;
    curve.marker = spall::Marker::dot;
    for (const Row &row : rows)
      if (row.method.rfind(way, 0) == 0)
      {
        curve.x.push_back(row.nanoseconds);
        curve.y.push_back(std::max(smallest_shown, row.errors.of(error)));
      }
    chart.curves.push_back(curve);
  }
  return chart;
}

void draw_all(const std::string &folder, const std::vector<Row> &rows)
{
  for (const spall::Chart &chart :
       {chart_of("geometry_gap", "Gap error / diameter (–)", &Errors::gap,
                 rows),
        chart_of("geometry_normal", "Normal error (degrees)", &Errors::angle,
                 rows),
        chart_of("geometry_arm", "Lever arm error / radius (–)", &Errors::arm,
                 rows)})
    std::ofstream(folder + "/" + chart.id + ".svg")
        << spall::svg_file(spall::draw(chart));
}
} // namespace

int main(int argc, char **argv)
{
  if (argc < 5)
  {
    std::fprintf(stderr, "geometry_cost PAIRS PICTURES TABLE.csv SHAPE.json "
                         "[SHAPE.json ...]\n");
    return 1;
  }
  omp_set_num_threads(1);
  ByOrder all;
  std::vector<Row> dots;
  for (int k = 4; k < argc; ++k)
  {
    const spall::ShapeFile shape = spall::read_shape(argv[k]);
    for (const int order : {8, 12, 20})
    {
      dem::Coefficients series = shape.coefficients;
      series.resize(static_cast<std::size_t>(std::min(
          dem::n_coefficients(order), dem::n_coefficients(shape.order))));
      const Pairs pairs(series, std::stoi(argv[1]));
      if (pairs.n_left_out > 0)
        std::fprintf(stderr, "%s, order %d: %d pairs left out, flat on flat\n",
                     shape.name.c_str(), order, pairs.n_left_out);
      const std::vector<Row> rows = measure_all(pairs);
      all[order].push_back(rows);
      dots.insert(dots.end(), rows.begin(), rows.end());
    }
  }
  write_ways(all, argv[3]);
  print_cache(all);
  draw_all(argv[2], dots);
}
