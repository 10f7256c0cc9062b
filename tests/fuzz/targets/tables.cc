// A load table and a share table (CSV); each is asked for values afterwards.
#include "fuzz.h"

#include <fem/drive.h>
#include <fem/train_load.h>

int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
  const std::string path =
      fuzz::scratch().write("table.csv", fuzz::bytes_of(data, size));
  fuzz::try_to(
      [&]
      {
        const fem::Drive load = fem::Drive::read_table(path);
        for (const double part : {-1., 0., 0.4, 1., 2.})
          load(part * load.last_time());
        load.integral();
      });
  fuzz::try_to(
      [&]
      {
        const fem::ShareTable share(path);
        for (const double part : {-1., 0., 0.4, 1., 2.})
          share(part * share.reach());
        share.integral();
      });
  return 0;
}
