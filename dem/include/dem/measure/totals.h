#pragma once

#include <dem/engine.h>
#include <dem/exact_sum.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

/// Sums and extremes over all ranks of what each of them has: the same bits on
/// any number of ranks. All functions are collective.
namespace dem
{
/// Sums entry by entry.
void sum_over_ranks(const Engine &engine, std::span<ExactSum> sums);
/// The largest entry by entry.
void largest_over_ranks(const Engine &engine, std::span<double> values);

/// Sums of n quantities over the particles: terms(i) has those of row i.
template <std::size_t n, class Terms>
std::array<double, n> sum_particles(const Engine &engine, const Terms &terms)
{
  std::array<ExactSum, n> sums;
  for (std::size_t i = 0; i < engine.particles().n_owned(); ++i)
  {
    const std::array<double, n> of_particle = terms(i);
    for (std::size_t q = 0; q < n; ++q)
      sums[q].add(of_particle[q]);
  }
  sum_over_ranks(engine, sums);
  std::array<double, n> values;
  for (std::size_t q = 0; q < n; ++q)
    values[q] = sums[q].value();
  return values;
}

/// Largest value(i) over the rows i of the particles, and at least `least`.
template <class Value>
double largest_of_particles(const Engine &engine, double least,
                            const Value &value)
{
  std::array largest{least};
  for (std::size_t i = 0; i < engine.particles().n_owned(); ++i)
    largest[0] = std::max(largest[0], value(i));
  largest_over_ranks(engine, largest);
  return largest[0];
}

/// Particles of all ranks.
std::int64_t total_particles(const Engine &engine);
/// Deepest overlaps over the contacts.
OverlapRecord total_overlaps(const Engine &engine);
/// Of contacts that follow the true surfaces, since construction.
ContactPointEvents total_contact_point_events(const Engine &engine);
/// Dissipated by sliding on the boundary so far [J].
double total_friction(const Engine &engine, const Boundary &boundary);
} // namespace dem
