#pragma once

#include "bench/closing.h"
#include "bench/measure.h"
#include "run/cost.h"

#include <optional>
#include <string>
#include <vector>

namespace spall
{
/// What one call of `spall bench` has found.
struct BenchResult
{
  std::string packing, scene,
      geometry; ///< geometry: sphere, or that of --geometry
  std::size_t n_particles = 0, n_breakable = 0;
  int threads = 1;
  bool is_breaking = false;
  dem::Vec3 box = dem::Vec3::Zero(); ///< [m]
  double solid_fraction = 0.;        ///< volume of particles / of the box [-]
  double coordination = 0.;          ///< at the start of the timed steps [-]
  double unbalanced_ratio = 0.;      ///< at the start of the timed steps [-]
  std::optional<ClosedBox> closed;   ///< if the box was closed
  MemoryUse before;                  ///< the packing read, no scene yet
  MemoryUse built;                  ///< particles and planes there, no step yet
  MemoryUse run;                    ///< after the first timed stretch
  std::vector<BenchSample> samples; ///< one of each repeat

  /// The sample with the median CPU time (the lower one of two).
  const BenchSample &median() const;
  bool is_reproducible() const; ///< all samples ended with the same bits
};

std::string bench_text(const BenchResult &result); ///< a table for people
std::string bench_json(const BenchResult &result); ///< SI, `name_unit` keys
} // namespace spall
