#include "subgrade/load.h"

#include "case/file.h"
#include "errors.h"
#include "specimen/csv_table.h"

#include <fem/drive.h>

#include <cmath>
#include <utility>

namespace spall
{
namespace
{
/// Beyond so many characteristic lengths the rail is taken to rest: the share
/// is below 5e-4 of that under the axle.
constexpr double rail_reach = 8.;

struct Shares
{
  fem::AxleShare of;
  double reach = 0.;    ///< [m]
  double integral = 0.; ///< [m]
};

Shares shares_of(const Case &c)
{
  const PulseParameters &p = c.subgrade.pulse;
  if (p.share == AxleShareForm::table)
  {
    const std::string path =
        find_path(c, "Pulse", "share_table", p.share_table);
    const ColumnPair rows = read_ascending(path, "distance_m,share_1");
    if (rows.first.size() < 2)
      throw InputError(path + ": must have two rows or more");
    const fem::ShareTable table(rows.first, rows.second);
    return {table, table.reach(), table.integral()};
  }
  const fem::RailBed bed{p.rail_stiffness, p.track_modulus, p.sleeper_spacing};
  return {[bed](double x) { return fem::sleeper_share(bed, x); },
          rail_reach * fem::characteristic_length(bed), p.sleeper_spacing};
}
} // namespace

fem::Train train_of(const PulseParameters &p)
{
  return {p.axle_load,  p.axle_spacing, p.bogie_spacing,
          p.car_length, p.cars,         p.speed};
}

SubgradeLoad::SubgradeLoad(const Case &c)
{
  const PulseParameters &p = c.subgrade.pulse;
  switch (p.form)
  {
  case PulseForm::haversine:
  case PulseForm::sine:
  {
    const bool is_sine = p.form == PulseForm::sine;
    const fem::Drive::Wave wave{p.amplitude, p.frequency};
    const fem::Drive drive =
        is_sine ? fem::Drive::sine(wave) : fem::Drive::haversine(wave);
    force = drive;
    if (p.pause > 0.)
      force = [drive, cycle = 1. / p.frequency, pause = p.pause](double time)
      {
        const double in_cycle = std::fmod(time, cycle + pause);
        return in_cycle < cycle ? drive(in_cycle) : 0.;
      };
    length = p.cycles / p.frequency + (p.cycles - 1) * p.pause;
    total = is_sine ? 0. : 0.5 * p.amplitude * p.cycles / p.frequency;
    return;
  }
  case PulseForm::eccentric_mass:
    force = fem::Drive::eccentric_mass(
        {p.eccentric_mass * p.eccentricity, p.frequency});
    length = p.cycles / p.frequency; // whole turns: no impulse
    return;
  case PulseForm::table:
  {
    ColumnPair rows = read_ascending(find_path(c, "Pulse", "table", p.table),
                                     "time_s,force_N");
    const auto table =
        fem::Drive::table(std::move(rows.first), std::move(rows.second));
    force = table;
    length = table.last_time();
    if (length <= 0.)
      throw std::invalid_argument("ends at 0 s: must be a load over time");
    total = table.integral();
    return;
  }
  case PulseForm::train:
    break;
  }
  const fem::Train train = train_of(p);
  const Shares shares = shares_of(c);
  const std::vector<double> axles = fem::axle_distances(train);
  const double first = shares.reach / train.speed;
  for (const double behind : axles)
    times.push_back(first + behind / train.speed);
  force = [train, shares, axles, first](double time)
  { return fem::train_load(train, axles, shares.of, time - first); };
  length = times.back() + first;
  total = train.axle_load / train.speed * shares.integral *
          static_cast<double>(axles.size());
}

double SubgradeLoad::operator()(double time) const
{
  return time < 0. || time > length ? 0. : force(time);
}
} // namespace spall
