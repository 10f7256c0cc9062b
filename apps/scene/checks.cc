#include "case/checks.h"

#include "case/parameter.h"
#include "scene/case.h"
#include "scene/kind.h"

#include <array>

namespace spall
{
namespace
{
void check_corners(const SourceLocation &location, const std::string &section,
                   const dem::Vec3 &lower, const dem::Vec3 &upper)
{
  if (!(lower.array() < upper.array()).all())
    refuse(location, {section, "upper", number_text(upper),
                      "must be above " + section + "/lower = " +
                          number_text(lower) + " along every axis"});
}

void check_box(const Case &c, const SourceLocation &location)
{
  const SceneBoxParameters &box = c.own<SceneCase>().box;
  check_corners(location, "Box", box.lower, box.upper);
}

/// Rigid faces are planes without end: beyond them is no room.
void check_in_box(const SourceLocation &location, const SceneCase &own)
{
  const SceneBoxParameters &box = own.box;
  const std::array faces = {box.x, box.y, box.z};
  const std::string but_open = ", where its faces are not open";
  for (Eigen::Index d = 0; d < 3; ++d)
  {
    if (faces[static_cast<std::size_t>(d)] == BoxFaces::open)
      continue;
    if (own.fill.lower[d] < box.lower[d])
      refuse(location, {"Fill", "lower", number_text(own.fill.lower),
                        "must be inside the box, from Box/lower = " +
                            number_text(box.lower) + but_open});
    if (own.fill.upper[d] > box.upper[d])
      refuse(location, {"Fill", "upper", number_text(own.fill.upper),
                        "must be inside the box, up to Box/upper = " +
                            number_text(box.upper) + but_open});
  }
}

void check_fill(const Case &c, const SourceLocation &location)
{
  const SceneCase &own = c.own<SceneCase>();
  if (own.fill.mass > 0.)
  {
    check_gradation(c, location, "Fill", own.fill.gradation);
    check_shapes(c, location, "Fill", own.fill.shapes);
    check_corners(location, "Fill", own.fill.lower, own.fill.upper);
    check_in_box(location, own);
  }
  else if (!own.fill.gradation.empty())
    refuse(location, {"Fill", "gradation", own.fill.gradation,
                      "must be empty unless Fill/mass is above 0"});
  if (own.fill.mass == 0. && own.scene.particles.empty())
    refuse(location, {"Scene", "particles", "",
                      "must name a file of particles, unless Fill/mass is "
                      "above 0"});
}
} // namespace

void check_scene(const Case &c, const SourceLocation &location)
{
  check_inertia(c, location);
  check_no_step_error(c, location);
  check_shapes(c, location, "Scene", c.own<SceneCase>().scene.shapes);
  check_box(c, location);
  check_fill(c, location);
}
} // namespace spall
