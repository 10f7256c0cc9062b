// A loading path of a triaxial test (CSV); what is read can be followed.
#include "triaxial/load_path.h"

#include "case/case.h"
#include "fuzz.h"

#include <cmath>

int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
  const std::string path =
      fuzz::scratch().write("path.csv", fuzz::bytes_of(data, size));
  for (const spall::Lateral lateral :
       {spall::Lateral::rigid, spall::Lateral::membrane})
    fuzz::try_to(
        [&]
        {
          spall::Case of;
          of.file = (fuzz::scratch().path() / "case.prm").string();
          of.boundary.lateral = lateral;
          const spall::LoadPath stages = spall::read_load_path(path, of);
          for (const double period : spall::expected_periods(stages, 30e3))
            if (std::isnan(period))
              fuzz::fail("a stage without a period");
        });
  return 0;
}
