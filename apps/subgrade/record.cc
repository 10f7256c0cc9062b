#include "subgrade/record.h"

#include "run/csv_file.h"

#include <dem/binary.h>
#include <dem/parallel/distribution.h>
#include <dem/parallel/rank_sums.h>
#include <fem/transfer_function.h>

#include <algorithm>
#include <cmath>

namespace spall
{
void Slice::add(double speed)
{
  ++n;
  sum_of_squares += speed * speed;
  peak = std::max(peak, speed);
}

void Slice::add(const SpeedSums &sums)
{
  n += sums.n;
  sum_of_squares += sums.sum_of_squares;
  peak = std::max(peak, sums.peak);
}

double Slice::rms() const
{
  return n > 0 ? std::sqrt(sum_of_squares / static_cast<double>(n)) : 0.;
}

void SubgradeRecord::begin(int n_slices, double top,
                           std::vector<double> ground_heights)
{
  slice_height = top / n_slices;
  particle_slices.resize(static_cast<std::size_t>(n_slices));
  for (std::size_t k = 0; k < particle_slices.size(); ++k)
    particle_slices[k].height = (static_cast<double>(k) + 0.5) * slice_height;
  for (const double height : ground_heights)
    ground_slices.push_back({height});
}

void SubgradeRecord::add(const SubgradeRow &row)
{
  time.push_back(row.time);
  load.push_back(row.load);
  plate.push_back(row.plate_velocity);
  ground.push_back(row.ground_velocity);
}

void SubgradeRecord::add_particles(const dem::Engine &engine,
                                   const Footprint &half)
{
  const dem::ParticleSystem &particles = engine.particles();
  const std::size_t n_slices = particle_slices.size();
  std::vector<dem::ExactSum> squares(n_slices);
  std::vector<std::int64_t> counts(n_slices, 0);
  std::vector<double> peaks(n_slices, 0.);
  for (std::size_t i = 0; i < particles.n_owned(); ++i)
  {
    const dem::Vec3 &at = particles.position(i);
    if (std::abs(at.x()) > half.half_x || std::abs(at.y()) > half.half_y ||
        at.z() < 0.)
      continue;
    const auto k = static_cast<std::size_t>(at.z() / slice_height);
    if (k >= n_slices)
      continue;
    squares[k].add(particles.velocity(i).squaredNorm());
    ++counts[k];
    peaks[k] = std::max(peaks[k], particles.velocity(i).norm());
  }
  const dem::Ranks &ranks = engine.distribution().ranks();
  dem::sum_over_ranks(ranks, squares, counts);
  ranks.max(peaks);
  for (std::size_t k = 0; k < n_slices; ++k)
    particle_slices[k].add(SpeedSums{counts[k], squares[k].value(), peaks[k]});
}

void SubgradeRecord::add_ground(std::span<const double> speed)
{
  for (std::size_t k = 0; k < speed.size(); ++k)
    ground_slices[k].add(speed[k]);
}

std::string SubgradeRecord::transfer_table(double highest) const
{
  const auto of_plate = fem::transfer_function({time, load, plate}, highest);
  const auto of_ground = fem::transfer_function({time, load, ground}, highest);
  std::string text = "frequency_Hz,load_Ns,plate_mobility_m_per_sN,"
                     "plate_phase_rad,subgrade_mobility_m_per_sN,"
                     "subgrade_phase_rad\n";
  for (std::size_t k = 0; k < of_plate.size(); ++k)
    text +=
        csv_row({of_plate[k].frequency, of_plate[k].load,
                 std::abs(of_plate[k].ratio), std::arg(of_plate[k].ratio),
                 std::abs(of_ground[k].ratio), std::arg(of_ground[k].ratio)});
  return text;
}

std::string SubgradeRecord::profile_table() const
{
  std::string text = "part_1,height_m,n_1,velocity_rms_m_per_s,"
                     "velocity_peak_m_per_s\n";
  for (const auto *slices : {&particle_slices, &ground_slices})
    for (const Slice &slice : *slices)
      text += csv_row({slices == &particle_slices ? 0. : 1., slice.height,
                       static_cast<double>(slice.n), slice.rms(), slice.peak});
  return text;
}

double SubgradeRecord::impulse() const
{
  double sum = 0.;
  for (std::size_t k = 1; k < time.size(); ++k)
    sum += 0.5 * (load[k] + load[k - 1]) * (time[k] - time[k - 1]);
  return sum;
}

void SubgradeRecord::save(std::ostream &out) const
{
  for (const auto *column : {&time, &load, &plate, &ground})
    dem::write_column(out, *column);
  dem::write_column(out, particle_slices);
  dem::write_column(out, ground_slices);
  dem::write_value(out, slice_height);
}

void SubgradeRecord::restore(std::istream &in)
{
  for (auto *column : {&time, &load, &plate, &ground})
    dem::read_column(in, *column);
  dem::read_column(in, particle_slices);
  dem::read_column(in, ground_slices);
  dem::read_value(in, slice_height);
}
} // namespace spall
