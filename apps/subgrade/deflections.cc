#include "subgrade/deflections.h"

#include "case/parameter.h"

#include <dem/binary.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace spall
{
Deflections::Deflections(const Case &c)
{
  const PulseParameters &p = c.subgrade.pulse;
  if (p.form != PulseForm::haversine || p.amplitude <= 0.)
    return;
  period = 1. / p.frequency + p.pause;
  most = static_cast<std::size_t>(p.cycles);
  force = p.amplitude;
  if (c.subgrade.plate.form == PlateForm::disc)
    radius = 0.5 * c.subgrade.plate.diameter;
}

void Deflections::note(double time, double settlement)
{
  if (period <= 0. || time < 0.)
    return;
  const auto number =
      std::min(most, static_cast<std::size_t>(time / period) + 1);
  while (pulses.size() < number)
  {
    const double start = pulses.empty() ? 0. : pulses.back().end;
    pulses.push_back({start, start, start});
  }
  Pulse &now = pulses.back();
  now.largest = std::max(now.largest, settlement);
  now.end = settlement;
}

double Deflections::modulus(double deflection) const
{
  return 1.5 * force / (std::numbers::pi * radius * deflection);
}

std::string Deflections::table() const
{
  std::string text = "pulse_1,deflection_m,settlement_m";
  text += radius > 0. ? ",dynamic_deformation_modulus_Pa\n" : "\n";
  for (std::size_t k = 0; k < pulses.size(); ++k)
  {
    const Pulse &pulse = pulses[k];
    text += std::to_string(k + 1) + "," + number_text(pulse.deflection()) +
            "," + number_text(pulse.end);
    if (radius > 0.)
      text += "," + number_text(modulus(pulse.deflection()));
    text += "\n";
  }
  return text;
}

void Deflections::summarise(nlohmann::ordered_json &summary) const
{
  if (pulses.empty())
    return;
  const std::size_t n = std::min<std::size_t>(3, pulses.size());
  double sum = 0.;
  for (std::size_t k = pulses.size() - n; k < pulses.size(); ++k)
    sum += pulses[k].deflection();
  const double mean = sum / static_cast<double>(n);
  summary["pulse_deflection_m"] = mean;
  if (radius > 0. && mean > 0.)
    summary["dynamic_deformation_modulus_Pa"] = modulus(mean);
}

void Deflections::save(std::ostream &out) const
{
  dem::write_column(out, pulses);
}

void Deflections::restore(std::istream &in)
{
  dem::read_column(in, pulses);
}
} // namespace spall
