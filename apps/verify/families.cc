#include "families.h"

namespace spall::verify
{
const std::vector<Family> &families()
{
  static const std::vector<Family> list = {
      laws(),     impacts(),  rolling(),  integration(), shape(),
      breakage(), membrane(), coupling(), network()};
  return list;
}
} // namespace spall::verify
