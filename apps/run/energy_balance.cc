#include "run/energy_balance.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>

namespace spall
{
EnergyBalance &EnergyBalance::operator-=(const EnergyBalance &start)
{
  external_work -= start.external_work;
  residual -= start.residual;
  non_conservative_work -= start.non_conservative_work;
  return *this;
}

double EnergyBalance::closure() const
{
  return external_work != 0. ? std::abs(residual / external_work) : 0.;
}

double EnergyBalance::non_conservative_ratio() const
{
  return external_work != 0. ? non_conservative_work / std::abs(external_work)
                             : 0.;
}

std::string describe(const EnergyBalance &balance)
{
  char text[200];
  std::snprintf(text, sizeof text,
                "energy balance of %.3g J external work: residual %.2e J (%.3g "
                "%%), non-conservative work %.2e J (%.3g %%)",
                balance.external_work, balance.residual,
                100. * balance.closure(), balance.non_conservative_work,
                100. * balance.non_conservative_ratio());
  return text;
}

void add_energy_balance(const EnergyBalance &balance,
                        nlohmann::ordered_json &summary)
{
  summary["energy_residual_ratio_1"] = balance.closure();
  summary["non_conservative_work_ratio_1"] = balance.non_conservative_ratio();
}
} // namespace spall
