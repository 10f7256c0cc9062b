#pragma once

#include <dem/contact/elasticity_table.h>
#include <dem/contact/law_table.h>
#include <dem/contact/rounding.h>

#include <limits>
#include <span>

namespace dem
{
/// Spacings of the numbers to which loads of contacts are rounded before they
/// are added up: powers of two. Sums of multiples of a spacing u are exact in
/// double up to 2^53 u, so they do not depend on the order of their terms: not
/// on threads, on ranks, nor on how particles are numbered. See
/// docs/developer/parallel.md.
struct SumGrid
{
  double force = 0.;  ///< [N]; 0: nothing is rounded
  double moment = 0.; ///< [N m]

  /// Largest component of the force of a contact: sums of 512 of them are
  /// exact [N].
  double largest_force() const
  {
    return force > 0. ? 0x1p44 * force
                      : std::numeric_limits<double>::infinity();
  }
  /// Spacing of loads on the vertices of surfaces, whose sums are integers of
  /// 64 bits: 8192 contacts of the largest force fit on a vertex [N].
  double vertex_load() const { return 0x1p-6 * force; }
  /// Sum of the sizes of forces up to which their sum is exact [N]; 0 where
  /// nothing is rounded.
  double largest_sum() const { return 0x1p53 * force; }
};

/// The spacings for contacts with forces of up to `largest_force` [N] on
/// particles of up to `largest_radius` [m]: 2^-44 of the force, and of the
/// force times the radius.
SumGrid sum_grid(double largest_force, double largest_radius);

/// Force of the stiffest of these laws where a sphere overlaps a plate by 1e-4
/// of its radius [N]: where the spacings of a scene begin. `n_materials` are
/// those of ElasticityTable.
double usual_force(std::span<const LawChoice> laws,
                   const ElasticityTable &elasticity, std::size_t n_materials,
                   double radius);
} // namespace dem
