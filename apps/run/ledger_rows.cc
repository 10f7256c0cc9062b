#include "run/ledger_rows.h"

#include "case/parameter.h"
#include "errors.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace spall
{
void require_energy(double residual, double time)
{
  if (!std::isfinite(residual))
    throw RunFailure("the energy is not a finite number at " +
                     number_text(time) +
                     " s: check the material values and the shapes");
}

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

void add_ledger(const coupling::Exchange &exchange,
                nlohmann::ordered_json &summary)
{
  const coupling::LedgerSums &sums = exchange.ledger();
  const auto triple = [](const dem::Vec3 &v) {
    return std::array<double, 3>{v.x(), v.y(), v.z()};
  };
  const auto per_window = [&exchange](std::int64_t n)
  {
    return static_cast<double>(n) /
           static_cast<double>(std::max<std::int64_t>(exchange.n_windows(), 1));
  };
  summary["interface"] = {
      {"work_given_J", sums.given},
      {"work_taken_J", sums.taken},
      {"work_residual_1", sums.work_residual()},
      {"impulse_given_Ns", triple(sums.impulse_given)},
      {"impulse_taken_Ns", triple(sums.impulse_taken)},
      {"impulse_residual_1", sums.impulse_residual()},
      {"passes_per_window_1", per_window(exchange.n_passes())},
      {"steps_per_window_1", per_window(exchange.n_particle_steps())},
      {"n_unsettled_windows", exchange.n_unsettled()}};
}
} // namespace spall
