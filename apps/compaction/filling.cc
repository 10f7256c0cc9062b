#include "compaction/filling.h"

#include "case/parameter.h"

namespace spall
{
std::string filling_text(const Case &parameters, const ShapeLibrary &shapes,
                         double longest_step)
{
  const std::string text =
      preparation_text(parameters, shapes, parameters.filling.safety);
  // Steps by the section Time are those that plate and sleeve allow, too.
  return parameters.filling.safety > 0.
             ? text
             : text + "longest step = " + number_text(longest_step) + "\n";
}
} // namespace spall
