// A load table and a share table (CSV); each is asked for values afterwards.
#include "fuzz.h"
#include "specimen/csv_table.h"

#include <fem/drive.h>
#include <fem/train_load.h>

int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
  const std::string path =
      fuzz::scratch().write("table.csv", fuzz::bytes_of(data, size));
  fuzz::try_to(
      [&]
      {
        spall::ColumnPair rows = spall::read_ascending(path, "time_s,force_N");
        const fem::Drive load =
            fem::Drive::table(std::move(rows.first), std::move(rows.second));
        for (const double part : {-1., 0., 0.4, 1., 2.})
          load(part * load.last_time());
        load.integral();
      });
  fuzz::try_to(
      [&]
      {
        spall::ColumnPair rows =
            spall::read_ascending(path, "distance_m,share_1");
        const fem::ShareTable share(std::move(rows.first),
                                    std::move(rows.second));
        for (const double part : {-1., 0., 0.4, 1., 2.})
          share(part * share.reach());
        share.integral();
      });
  return 0;
}
