#include "compaction/filling.h"

namespace spall
{
namespace
{
/// Friction among particles is Filling/friction, and that of Particle for their
/// last rest; damping is Filling/local_damping.
constexpr CaseKey deciding[] = {{"Container", "diameter"},
                                {"Container", "height"},
                                {"Filling"},
                                {"Particle", "friction"}};

constexpr CaseKey later[] = {{"Container", "form"},
                             {"Container", "elements_around"},
                             {"Container", "freeboard"},
                             {"Container", "pressure"},
                             {"Plate"},
                             {"Vibration"}};
} // namespace

const PreparationKeys &filling_keys()
{
  static const PreparationKeys keys(deciding, later);
  return keys;
}

std::string filling_text(const Case &parameters, const ShapeLibrary &shapes,
                         double longest_step)
{
  const std::string text = preparation_text(
      parameters, filling_keys(), shapes, parameters.filling.safety,
      [](const Parameter &) { return false; });
  // Steps as Time says are those that plate and sleeve allow, too.
  return parameters.filling.safety > 0.
             ? text
             : text + "longest step = " + number_text(longest_step) + "\n";
}
} // namespace spall
