#include "ledger_rows.h"

namespace spall
{
std::string ledger_header()
{
  return "time_s,work_given_J,work_taken_J,work_residual_1,impulse_given_x_Ns,"
         "impulse_given_y_Ns,impulse_given_z_Ns,impulse_taken_x_Ns,"
         "impulse_taken_y_Ns,impulse_taken_z_Ns,impulse_residual_1,gain_1,"
         "passes_1,gap_m";
}

std::vector<double> ledger_row(const coupling::Exchange &exchange,
                               const dem::Engine &engine, double window)
{
  const coupling::LedgerSums &sums = exchange.ledger();
  std::vector<double> row{engine.time(), sums.given, sums.taken,
                          sums.work_residual()};
  for (const dem::Vec3 &impulse : {sums.impulse_given, sums.impulse_taken})
    row.insert(row.end(), impulse.begin(), impulse.end());
  const coupling::WindowReport &last = exchange.last_window();
  for (const double more :
       {sums.impulse_residual(), exchange.gain(engine, window),
        static_cast<double>(last.passes), last.gap})
    row.push_back(more);
  return row;
}
} // namespace spall
