#pragma once

#include "triaxial/load_follower.h"
#include "triaxial/sample.h"

#include <dem/measure/hysteresis.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace spall
{
/// stages.csv: what each stage of a loading path ends with.
inline constexpr const char *stages_file = "stages.csv";

/// The last loops of a stage, as standards take their means. Plain data.
class LoopMeans
{
public:
  void add(const dem::Hysteresis &loop);

  double cyclic_stress() const;     ///< mean [Pa]; NaN without a loop
  double resilient_strain() const;  ///< mean [-]; NaN without a loop
  double resilient_modulus() const; ///< mean [Pa]; NaN without a loop
  double damping_ratio() const;     ///< mean [-]; NaN without a loop

private:
  static constexpr std::size_t most = 5; ///< cycles of a mean
  using Column = std::array<double, most>;
  double mean(const Column &values) const;

  std::int64_t n = 0;
  Column stress = {}, strain = {}, modulus = {}, damping = {};
};

std::string stages_header();

/// The row of a stage that is over; `row` is that of history.csv, `cycles`
/// those of the stage.
std::vector<double> stage_values(const LoadFollower &follower,
                                 const Sample &row, double cycles,
                                 const LoopMeans &loops);
} // namespace spall
