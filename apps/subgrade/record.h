#pragma once

#include "subgrade/case.h"

#include <dem/engine.h>

#include <iosfwd>
#include <string>
#include <vector>

namespace spall
{
/// What one row of the loading adds; velocities down [m/s].
struct SubgradeRow
{
  double time = 0.; ///< since loading began [s]
  double load = 0.; ///< the pulse, down [N]
  double plate_velocity = 0., ground_velocity = 0.;
};

/// Speeds of what lies in one slice of height, in one row.
struct SpeedSums
{
  std::int64_t n = 0;         ///< speeds
  double sum_of_squares = 0.; ///< [m^2/s^2]
  double peak = 0.;           ///< [m/s]
};

/// The same over the rows.
struct Slice
{
  double height = 0.; ///< of its middle [m]
  std::int64_t n = 0; ///< speeds that were added
  double sum_of_squares = 0., peak = 0.;

  void add(double speed);
  void add(const SpeedSums &sums);
  double rms() const; ///< [m/s]
};

/// Series and profiles of the loading, from which transfer.csv and profile.csv
/// are made when the test ends.
class SubgradeRecord
{
public:
  void begin(int n_slices, double top, std::vector<double> ground_heights);
  void add(const SubgradeRow &row);
  /// Particles of all ranks whose centres lie below the footprint of the plate.
  /// Collective.
  void add_particles(const dem::Engine &engine, const Footprint &plate);
  /// Speeds of the ground at its heights, down its middle.
  void add_ground(std::span<const double> speed);

  /// frequency_Hz, load_Ns and |V / F| with its phase of plate and ground.
  std::string transfer_table(double highest_frequency) const;
  /// part_1 (0 particles, 1 subgrade), height_m, n_1, rms and peak.
  std::string profile_table() const;
  /// int load dt of the rows [N s].
  double impulse() const;

  void save(std::ostream &out) const;
  void restore(std::istream &in);

private:
  std::vector<double> time, load, plate, ground;
  std::vector<Slice> particle_slices, ground_slices;
  double slice_height = 0.; ///< [m]
};
} // namespace spall
