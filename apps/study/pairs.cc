#include "study/pairs.h"

#include <cmath>
#include <map>

namespace spall
{
namespace
{
using SamplesBySeed = std::map<std::string, std::vector<double>>;

SeedValues means_of(const SamplesBySeed &samples)
{
  SeedValues means;
  for (const auto &[seed, values] : samples)
    means[seed] = estimate_of(values).mean;
  return means;
}

bool has_given(const StudyData &data, const Cut &cut, std::size_t point,
               std::size_t outcome)
{
  return data.results[point].is_done && cut.takes(data.points[point]) &&
         std::isfinite(data.results[point].outcomes[outcome]);
}

/// All differences of two cases but this key.
std::vector<std::string> all_but(const StudyPoint &point, std::size_t key)
{
  std::vector<std::string> rest = point.values;
  rest[key] = point.seed;
  return rest;
}
} // namespace

SeedValues seed_means(const StudyData &data, const Cut &cut,
                      std::size_t outcome)
{
  SamplesBySeed samples;
  for (std::size_t p = 0; p < data.points.size(); ++p)
    if (has_given(data, cut, p, outcome))
      samples[data.points[p].seed].push_back(data.results[p].outcomes[outcome]);
  return means_of(samples);
}

SeedValues paired_differences(const StudyData &data, const Cut &cut,
                              std::size_t outcome, const std::string &from,
                              const std::string &to)
{
  std::map<std::vector<std::string>, double> before;
  for (std::size_t p = 0; p < data.points.size(); ++p)
    if (has_given(data, cut, p, outcome) &&
        data.points[p].values[cut.key] == from)
      before[all_but(data.points[p], cut.key)] =
          data.results[p].outcomes[outcome];
  SamplesBySeed samples;
  for (std::size_t p = 0; p < data.points.size(); ++p)
    if (has_given(data, cut, p, outcome) &&
        data.points[p].values[cut.key] == to)
      if (const auto partner = before.find(all_but(data.points[p], cut.key));
          partner != before.end())
        samples[data.points[p].seed].push_back(
            data.results[p].outcomes[outcome] - partner->second);
  return means_of(samples);
}

SeedValues combined(const SeedValues &one, const SeedValues &other,
                    const std::function<double(double, double)> &of)
{
  SeedValues all;
  for (const auto &[seed, value] : one)
    if (const auto found = other.find(seed); found != other.end())
      all[seed] = of(value, found->second);
  return all;
}

Estimate estimate_of(const SeedValues &values)
{
  std::vector<double> samples;
  for (const auto &[seed, value] : values)
    samples.push_back(value);
  return estimate_of(samples);
}
} // namespace spall
