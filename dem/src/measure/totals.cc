#include <dem/measure/totals.h>
#include <dem/parallel/distribution.h>
#include <dem/parallel/rank_sums.h>

namespace dem
{
void sum_over_ranks(const Engine &engine, std::span<ExactSum> sums)
{
  sum_over_ranks(engine.distribution().ranks(), sums);
}

void largest_over_ranks(const Engine &engine, std::span<double> values)
{
  engine.distribution().ranks().max(values);
}

std::int64_t total_particles(const Engine &engine)
{
  std::array n{static_cast<std::int64_t>(engine.particles().n_owned())};
  engine.distribution().ranks().sum(n);
  return n[0];
}

OverlapRecord total_overlaps(const Engine &engine)
{
  return largest_over_ranks(engine.distribution().ranks(), engine.overlaps());
}

ContactPointEvents total_contact_point_events(const Engine &engine)
{
  return sum_over_ranks(engine.distribution().ranks(),
                        engine.contact_point_events());
}

double total_friction(const Engine &engine, const Boundary &boundary)
{
  std::array sum{boundary.friction};
  sum_over_ranks(engine, sum);
  return sum[0].value();
}
} // namespace dem
