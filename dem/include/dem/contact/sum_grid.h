#pragma once

#include <dem/contact/elasticity_table.h>
#include <dem/contact/law_table.h>

#include <limits>
#include <span>

namespace dem
{
/// Spacings of the numbers to which loads and losses of contacts are rounded
/// before they are added up: powers of two. Sums of multiples of a spacing u
/// are exact in double up to 2^53 u, so they do not depend on the order of
/// their terms: not on threads, on ranks, nor on how particles are numbered.
/// See docs/developer/parallel.md.
struct SumGrid
{
  double force = 0.;  ///< [N]; 0: nothing is rounded
  double moment = 0.; ///< [N m]
  double loss = 0.;   ///< [J]

  /// Largest component of a load that a sum may have and be exact, with a
  /// reserve for sums that are larger before all terms are in.
  double largest_force() const { return reach(force); }
  double largest_moment() const { return reach(moment); }
  /// Largest loss of a range of contacts in a step [J].
  double largest_loss() const { return reach(loss); }
  /// Sum of the sizes of forces up to which their sum is exact [N]; 0 where
  /// nothing is rounded.
  double largest_sum() const { return 0x1p53 * force; }

private:
  static double reach(double spacing)
  {
    return spacing > 0. ? 0x1p51 * spacing
                        : std::numeric_limits<double>::infinity();
  }
};

/// What the spacings of a scene follow from.
struct LargestLoad
{
  double radius = 0.;  ///< of the particle, R [m]
  double overlap = 1.; ///< that few contacts exceed, over R [-]
  double factor = 1.;  ///< on the force of such a contact, a power of two [-]
};

/// The spacings of a scene with these contact laws: 2^-50 of the force F of the
/// stiffest one where a particle overlaps a plate by `largest`, and
/// 2^-50 F R for moments, 2^-50 F R for losses. `n_materials` are those of
/// ElasticityTable.
SumGrid sum_grid(std::span<const LawChoice> laws,
                 const ElasticityTable &elasticity, std::size_t n_materials,
                 const LargestLoad &largest);

/// What is added to a number and taken away again to round it to a multiple of
/// the spacing u: 1.5 * 2^52 u. Numbers below 2^51 u are rounded to the nearest
/// multiple, larger ones to one of 2 u, 4 u and so on.
constexpr double rounding_shift(double spacing)
{
  return 0x1.8p52 * spacing;
}
} // namespace dem
