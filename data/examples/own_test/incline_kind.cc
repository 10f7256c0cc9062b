#include "incline_kind.h"

#include <dem/binary.h>
#include <dem/engine_boundaries.h>

#include <nlohmann/json.hpp>

#include <case/checks.h>
#include <case/gravity.h>
#include <case/list.h>
#include <case/parameter.h>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <report/kind_report.h>
#include <report/path_charts.h>
#include <test/test.h>

namespace
{
using namespace spall;

// The scene: x points down the slope, z away from the plane.
std::unique_ptr<dem::Engine> make_scene(const Case &c)
{
  const auto &own = c.own<InclineParameters>();
  const double angle = own.angle * std::numbers::pi / 180.;
  dem::EngineParameters settings;
  settings.particle = c.particle;
  settings.wall = settings.surface = c.wall;
  settings.geometry = c.contact;
  settings.local_damping = 0.;
  settings.gravity = gravity * dem::Vec3(std::sin(angle), 0., -std::cos(angle));
  auto engine = std::make_unique<dem::Engine>(settings);
  engine->add_particle(dem::make_sphere(own.radius),
                       own.radius * dem::Vec3::UnitZ(),
                       dem::Quaternion::Identity());
  dem::add_plane(*engine, dem::Vec3::Zero(), dem::Vec3::UnitZ());
  return engine;
}

class Incline : public Test
{
public:
  explicit Incline(const Case &c)
      : Test(c, {}, make_scene(c)), own(parameters.own<InclineParameters>())
  {
  }

  double share_done() const override { return engine().time() / own.duration; }
  double duration() const override { return own.duration; }
  double progress_at(double time) const override { return time; }
  const char *progress_column() const override { return "time_s"; }
  std::string phase() const override { return "rolling"; }
  std::string outcome() const override
  {
    char text[40];
    std::snprintf(text, sizeof text, "path %.4g m", path());
    return text;
  }
  Due due() const override
  {
    const auto row_at = [this](double time)
    { return std::floor(time / own.duration * own.rows + 1e-9); };
    Due due;
    due.row = row_at(time_before) != row_at(engine().time());
    return due;
  }
  void summarise(nlohmann::ordered_json &summary) const override
  {
    Test::summarise(summary);
    summary["path_m"] = path();
  }
  void save(std::ostream &out, dem::StateExtent extent) const override
  {
    Test::save(out, extent);
    dem::write_value(out, time_before);
  }
  void restore(std::istream &in) override
  {
    Test::restore(in);
    dem::read_value(in, time_before);
  }

private:
  void move(double time_step) override
  {
    time_before = engine().time();
    engine().advance_deferred(time_step);
  }
  std::vector<Quantity> measured() const override
  {
    return {{"path_m", path(), true}};
  }
  double path() const { return engine().particles().position(0).x(); }

  InclineParameters own;
  double time_before = 0.; ///< at the last step [s]
};

void add_parameters(List &list, Case &of)
{
  auto &own = of.own<InclineParameters>();
  list.in("Incline");
  list.add({"angle", "degrees", "Angle of the plane against the horizontal."},
           own.angle, between(0., 89.));
  list.add({"radius", "m", "Radius of the sphere."}, own.radius, above(0., 1.));
  list.add({"duration", "s", "Duration of the test."}, own.duration,
           above(0., 1e3));
  list.add({"rows", "-", "Rows of history.csv."}, own.rows, between(1, 1e6))
      .may_change = true;
}

void set_defaults(Case &c)
{
  c.title = "sphere on an incline";
  c.wall.friction = 0.5;
  c.wall.rolling_friction = 0.;
  c.time.step = StepRule::stable;
}

void check(const Case &c, const SourceLocation &location)
{
  const double angle =
      c.own<InclineParameters>().angle * std::numbers::pi / 180.;
  if (std::tan(angle) > 3.5 * c.wall.friction)
    refuse(location,
           {"Wall", "friction", number_text(c.wall.friction),
            "must be at least 2/7 of the tangent of Incline/angle: the "
            "sphere would slip"});
  check_no_step_error(c, location);
}

const KindReport &report()
{
  static const KindReport report = {
      .headlines = {{"Path", " mm",
                     [](const RunData &run)
                     { return 1e3 * last(run, "path_m"); }}},
      .rows = {number_row(ReportSection::response, "Path (mm)", "path_m", 1e3,
                          4)},
      .charts = [](std::span<const RunData> runs)
      {
        return std::vector<Chart>{
            path_chart(runs, {"time_s", "Time (s)"},
                       {"path", ReportSection::response, "path_m", "Path (mm)",
                        "Path of the centre of the sphere.", 1e3})};
      }};
  return report;
}
} // namespace

TestKind incline_kind()
{
  return {.name = "incline",
          .sections = {{"Incline", "A sphere that rolls down a plane."}},
          .shared_sections = {},
          .add_parameters = add_parameters,
          .set_defaults = set_defaults,
          .check = check,
          .make = [](const Case &c) -> std::unique_ptr<Test>
          { return std::make_unique<Incline>(c); },
          .seed_key = "",
          .report = report};
}
