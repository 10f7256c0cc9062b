#include "triaxial/load_path.h"

#include "case/case.h"
#include "case/file.h"
#include "case/parameter.h"
#include "run/digest.h"

#include <algorithm>
#include <cmath>

namespace spall
{
namespace
{
LoadPath haversine_path(const LoadingParameters &l)
{
  LoadStage stage;
  stage.name = "haversine";
  stage.wave = {WaveForm::haversine, l.frequency};
  stage.amplitude = l.amplitude;
  stage.cycles = l.cycles;
  stage.is_over_first_section = true;
  return {{stage}};
}

LoadPath compression_path(const LoadingParameters &l)
{
  LoadStage stage;
  stage.name = "compression";
  stage.axial = {LoadControl::strain, l.final_strain, l.strain_rate};
  return {{stage}};
}

std::string text_of(const std::optional<double> &number)
{
  return number ? number_text(*number) : "-";
}

std::string text_of(const LoadDirection &d)
{
  return std::to_string(static_cast<int>(d.control)) + " " + text_of(d.target) +
         " " + text_of(d.rate);
}

std::string text_of(const Wave &wave)
{
  if (wave.form == WaveForm::none)
    return "none";
  Digest points;
  points.add(wave.table.share);
  points.add(wave.table.value);
  return wave_names()[static_cast<std::size_t>(wave.form) - 1] + " " +
         number_text(wave.frequency) + " " + number_text(wave.rest) + " " +
         hex_text(points.value());
}

/// What is known of a specimen before it is loaded.
struct Expected
{
  double stress = 0., strain = 0.; ///< of one direction [Pa], [-]

  double &of(LoadControl control)
  {
    return control == LoadControl::strain ? strain : stress;
  }
};
} // namespace

bool LoadPath::has_waves() const
{
  return std::ranges::any_of(stages, &LoadStage::has_wave);
}

int LoadPath::n_cycles() const
{
  int n = 0;
  for (const LoadStage &stage : stages)
    n += stage.n_cycles();
  return n;
}

bool LoadPath::needs_stresses() const
{
  return std::ranges::any_of(
      stages, [](const LoadStage &stage)
      { return stage.rule == SideRule::proportional || stage.until_ratio; });
}

LoadPath load_path_of(const Case &c)
{
  switch (c.loading.form)
  {
  case LoadForm::haversine:
    return haversine_path(c.loading);
  case LoadForm::compression:
    return compression_path(c.loading);
  case LoadForm::path:
    break;
  }
  return read_load_path(find_path(c, "Loading", "path", c.loading.path), c);
}

std::string text_of(const LoadStage &s)
{
  std::string text = s.name + "; axial " + text_of(s.axial) + "; x " +
                     text_of(s.sides[0]) + "; y " + text_of(s.sides[1]);
  text += "; rule " + std::to_string(static_cast<int>(s.rule)) + " " +
          number_text(s.side_ratio) + "; wave " + text_of(s.wave) + " " +
          number_text(s.amplitude) + " " + number_text(s.side_amplitude);
  text += "; duration " + number_text(s.duration) +
          (s.is_over_first_section ? "; first section" : "; present section");
  return text + "; until " + text_of(s.until_strain) + " " +
         text_of(s.until_ratio) + " " + text_of(s.until_unbalanced);
}

double end_of(const LoadDirection &d, double start, double duration)
{
  if (d.target)
    return *d.target;
  return d.rate ? start + *d.rate * duration : start;
}

double own_length(const LoadDirection &d, double start)
{
  return d.has_own_length() ? std::abs(*d.target - start) / std::abs(*d.rate)
                            : 0.;
}

std::vector<double> expected_periods(const LoadPath &path,
                                     double confining_pressure)
{
  std::array<Expected, 3> now;
  now.fill({confining_pressure, 0.});
  std::vector<double> periods;
  for (const LoadStage &stage : path.stages)
  {
    const std::array<const LoadDirection *, 3> directions = {
        &stage.axial, &stage.sides[0], &stage.sides[1]};
    double period = stage.has_wave() ? stage.wave.period() : stage.duration;
    for (std::size_t d = 0; d < 3; ++d)
      period = std::max(period, own_length(*directions[d],
                                           now[d].of(directions[d]->control)));
    for (std::size_t d = 0; d < 3; ++d)
    {
      double &value = now[d].of(directions[d]->control);
      value = end_of(*directions[d], value, period * stage.n_cycles());
    }
    periods.push_back(period);
  }
  return periods;
}
} // namespace spall
