#include "surfaces.h"

#include <dem/contact/damage.h>

#include <cmath>

namespace dem
{
namespace
{
/// Marks prefactors as out of date; more than any tolerance [rad].
constexpr Narrow not_mixed = 10;

/// World direction of kappa_max of a side.
Vec3 first_direction(const ForceContext &context, std::int32_t particle,
                     const SideCurvature &curvature)
{
  const auto &d = curvature.first_direction;
  return context.particles.orientation(row_of(particle)) *
         Vec3(d[0], d[1], d[2]);
}

void note_expansion(SideColumns &side, std::size_t k, const RadialExpansion &at)
{
  const Vec3 &g = at.gradient;
  const Mat3 &h = at.hessian;
  side.radius[k] = at.radius;
  side.gradient.set(k, {g.x(), g.y(), g.z()});
  const double entries[6] = {h(0, 0), h(1, 1), h(2, 2),
                             h(0, 1), h(0, 2), h(1, 2)};
  for (std::size_t c = 0; c < 6; ++c)
    side.hessian[c][k] = static_cast<Narrow>(entries[c]);
}

/// Prefactors::radius of contact k for laws that use it.
void note_reduced_radius(const GapCoefficients &gap, ContactBatch &batch,
                         std::size_t k)
{
  if (batch.layout.has_attraction)
    batch.reduced_radius[k] =
        static_cast<Narrow>(0.5 / std::sqrt(gap.a * gap.b));
}
} // namespace

void renew_side(const ForceContext &context, ContactBatch &batch, std::size_t k,
                bool is_a, const Vec3 &direction)
{
  const std::int32_t particle = is_a ? batch.a[k] : batch.b[k];
  SideColumns &side = is_a ? batch.side_a : batch.side_b;
  // Evaluated at the direction of the column, to the last digit of the column.
  // A cast of the whole vector will not do: GCC 12 leaves out the way over
  // float.
  side.direction.set(k, {direction.x(), direction.y(), direction.z()});
  const Triple<double> in_column = side.direction[k];
  const Vec3 rounded = Vec3(in_column.x, in_column.y, in_column.z).normalized();
  const SurfaceSide fresh =
      evaluate_side(context.particles.shape[row_of(particle)], rounded,
                    context.parameters.breakage.curvature_floor_ratio);
  if (batch.layout.has_contact_points)
    side.set_paraboloid(k, surface_point(fresh.expansion));
  else
    note_expansion(side, k, fresh.expansion);
  side.curvature[k] = fresh.curvature;
  if (batch.layout.has_partners)
    batch.torsion_angle[k] = not_mixed;
  else if (batch.layout.has_prefactors)
    set_wall_prefactors(context, batch, k);
  if (batch.layout.has_damage)
    note_corner(context.particles, batch, k, is_a);
}

void note_corner(const ParticleSystem &particles, ContactBatch &batch,
                 std::size_t k, bool is_a)
{
  const SideCurvature &curvature =
      (is_a ? batch.side_a : batch.side_b).curvature[k];
  const std::int32_t particle = is_a ? batch.a[k] : batch.b[k];
  const bool may_break =
      curvature.is_corner != 0 && particles.is_breakable[row_of(particle)] != 0;
  (is_a ? batch.corner_a : batch.corner_b)[k] =
      may_break ? static_cast<Narrow>(cap_slope(curvature.gaussian()))
                : Narrow(0);
}

void forget_side(ContactBatch &batch, std::size_t k, bool is_a)
{
  if (!batch.layout.has_sides)
    return;
  SideColumns &side = is_a ? batch.side_a : batch.side_b;
  if (!batch.layout.has_contact_points)
  {
    side.direction.set(k, {});
    side.radius[k] = 0.;
    return;
  }
  // A contact that follows its surface starts from there.
  const Triple<double> u = side.direction[k];
  if (dot(u, u) > 0.)
  {
    const Vec3 at = side.contact_point(k);
    side.direction.set(k, {at.x(), at.y(), at.z()});
  }
  side.height[k] = 0.;
}

void mix_prefactors(const ForceContext &context, ContactBatch &batch,
                    std::size_t k, const Vec3 &normal)
{
  const SideCurvature &a = batch.side_a.curvature[k],
                      &b = batch.side_b.curvature[k];
  // The directions lie in planes a few degrees apart; compare their parts
  // across the branch.
  const auto flat = [&normal](const Vec3 &v)
  { return Vec3(v - v.dot(normal) * normal); };
  const Vec3 flat_a = flat(first_direction(context, batch.a[k], a));
  const Vec3 flat_b = flat(first_direction(context, batch.b[k], b));
  const double norms = flat_a.squaredNorm() * flat_b.squaredNorm();
  const double dot = flat_a.dot(flat_b);
  PairCurvatures pair{a.first, a.second, b.first, b.second, 1.};
  if (norms > 0.)
    pair.cos_2psi = 2. * dot * dot / norms - 1.;
  const GapCoefficients gap = gap_coefficients(pair);
  const auto &material = context.particles.material;
  const HertzPrefactors prefactors =
      elliptic_table()(context.elasticity.pair(material[row_of(batch.a[k])],
                                               material[row_of(batch.b[k])]),
                       gap);
  batch.normal_prefactor[k] = prefactors.normal;
  batch.shear_prefactor[k] = prefactors.tangential;
  note_reduced_radius(gap, batch, k);
  batch.torsion_angle[k] = 0;
  if (batch.layout.has_damage &&
      context.parameters.breakage.curvature == CapCurvature::relative)
    for (Narrow *corner : {&batch.corner_a[k], &batch.corner_b[k]})
      if (*corner > 0)
        *corner = static_cast<Narrow>(cap_slope(4. * gap.a * gap.b));
}

void set_wall_prefactors(const ForceContext &context, ContactBatch &batch,
                         std::size_t k)
{
  const SideCurvature &side = batch.side_a.curvature[k];
  const GapCoefficients gap =
      gap_coefficients({side.first, side.second, 0., 0., 1.});
  const HertzPrefactors prefactors =
      elliptic_table()(context.elasticity.on_plate(
                           context.particles.material[row_of(batch.a[k])]),
                       gap);
  batch.normal_prefactor[k] = prefactors.normal;
  batch.shear_prefactor[k] = prefactors.tangential;
  note_reduced_radius(gap, batch, k);
}
} // namespace dem
