#include "case.h"

#include <cmath>

namespace spall::verify
{
Row at_most(const std::string &quantity, const std::string &unit, double value,
            double limit)
{
  return {quantity, unit, 0., value, limit, 1.};
}

double error_of(const Row &row)
{
  const double scale = row.scale > 0. ? row.scale : std::abs(row.reference);
  return std::abs(row.computed - row.reference) / scale;
}

bool is_held(const Row &row)
{
  return error_of(row) <= row.tolerance;
}
} // namespace spall::verify
