#include "scene/kind.h"

#include "scene/case.h"
#include "scene/scene.h"

#include <array>
#include <utility>

namespace spall
{
namespace
{
void set_defaults(Case &c)
{
  c.title = "scene of particles and walls";
  c.wall.law = "hertz";
  c.contact.geometry = c.contact.wall_geometry = dem::ContactGeometry::sphere;
  c.time.step = StepRule::stable;
  c.time.local_damping = 0.; // particles fly
}

void set_template(Case &c)
{
  auto &own = c.own<SceneCase>();
  own.fill.mass = 10.;
  own.fill.gradation = "gradations/los_angeles_20_45mm.csv";
  own.box.x = own.box.y = own.box.z = BoxFaces::rigid;
}

std::string one_rank_setting(const Case &parameters)
{
  const SceneBoxParameters &box = parameters.own<SceneCase>().box;
  const std::array<std::pair<const char *, BoxFaces>, 3> all{
      {{"x", box.x}, {"y", box.y}, {"z", box.z}}};
  for (const auto &[key, faces] : all)
    if (faces == BoxFaces::periodic)
      return std::string("Box/") + key + " = periodic";
  return {};
}

std::unique_ptr<Test> make(const Case &parameters)
{
  return std::make_unique<Scene>(parameters);
}
} // namespace

TestKind scene_kind()
{
  return {
      .name = "scene",
      .sections =
          {{"Scene",
            "Placed particles, gravity, duration and output of a scene."},
           {"Box",
            "Box around the particles with open, rigid or periodic faces."},
           {"Fill",
            "Particles that are drawn from a gradation and placed at random."},
           {"Other", "Second material (other) of placed particles, which do "
                     "not break."}},
      .shared_sections = {"Walls"},
      .add_parameters = add_scene,
      .set_defaults = set_defaults,
      .set_template = set_template,
      .check = check_scene,
      .make = make,
      .runs_on_many_ranks = true,
      .needs_one_rank = one_rank_setting,
      .seed_key = "Fill/seed",
      .gradation_section = "Fill",
      .report = scene_report};
}
} // namespace spall
