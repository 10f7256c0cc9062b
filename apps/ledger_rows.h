#pragma once

#include <coupling/exchange.h>

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace spall
{
/// Columns of ledger.csv that every exchange has.
inline constexpr const char *ledger_columns =
    "time_s,work_given_J,work_taken_J,work_residual_1,impulse_given_x_Ns,"
    "impulse_given_y_Ns,impulse_given_z_Ns,impulse_taken_x_Ns,"
    "impulse_taken_y_Ns,impulse_taken_z_Ns,impulse_residual_1,gain_1,"
    "passes_1,gap_m";

std::vector<double> ledger_row(double time, const coupling::Exchange &exchange,
                               double gain);

/// The sums of the whole run, for summary.json.
void add_ledger(const coupling::Exchange &exchange,
                nlohmann::ordered_json &summary);
} // namespace spall
