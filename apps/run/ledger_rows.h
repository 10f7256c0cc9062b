#pragma once

#include <coupling/exchange.h>

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace spall
{
/// Throws RunFailure where the residual of the energy balance has become no
/// number [J], at this time [s].
void require_energy(double residual, double time);

/// Columns of ledger.csv that every test with an exchange has.
std::string ledger_header();

/// A row of them; `window` is the present one [s].
std::vector<double> ledger_row(const coupling::Exchange &exchange,
                               const dem::Engine &engine, double window);

/// The sums of the whole run, for summary.json.
void add_ledger(const coupling::Exchange &exchange,
                nlohmann::ordered_json &summary);
} // namespace spall
