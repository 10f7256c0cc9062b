#include "errors.h"
#include "run/ledger_rows.h"

#include <gtest/gtest.h>

#include <limits>

namespace spall
{
namespace
{
TEST(RequireEnergy, StopsAtNoNumber)
{
  EXPECT_NO_THROW(require_energy(-0.3, 1.));
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity()})
    EXPECT_THROW(require_energy(bad, 1.), RunFailure);
}
} // namespace
} // namespace spall
