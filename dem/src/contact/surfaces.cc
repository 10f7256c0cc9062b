#include "surfaces.h"

#include <dem/breakage/criterion.h>

namespace dem
{
namespace
{
/// Marks prefactors as out of date; more than any tolerance [rad].
constexpr float not_mixed = 10.f;

/// World direction of kappa_max of a side.
Vec3 first_direction(const ForceContext &context, std::int32_t stone,
                     const SideCurvature &curvature)
{
  const auto &d = curvature.first_direction;
  return context.particles.orientation(row_of(stone)) * Vec3(d[0], d[1], d[2]);
}

/// Energy of a normal spring in the last and in this step.
struct DamageEnergy
{
  double overlap = 0.;          ///< now [m]
  double before = 0., now = 0.; ///< [J]
};

bool damage_side(const ForceContext &context, std::int32_t stone,
                 const SideCurvature &curvature, const DamageEnergy &energy,
                 double &factor)
{
  const BreakageParameters &breakage = context.parameters.breakage;
  if (curvature.is_corner == 0 ||
      !context.particles.is_breakable[row_of(stone)])
    return false;
  const Cap cap = cap_of(energy.overlap, curvature.gaussian());
  const DamageStep step = damage_step(factor, energy.before, energy.now,
                                      breakage.fracture_energy * cap.area);
  factor = step.factor;
  return step.mode != BreakageMode::none;
}
} // namespace

void renew_side(const ForceContext &context, ContactBatch &batch, std::size_t k,
                bool is_a, const Vec3 &direction)
{
  const std::int32_t stone = is_a ? batch.a[k] : batch.b[k];
  SideColumns &side = is_a ? batch.side_a : batch.side_b;
  // Evaluated where the column says, to the last digit of the column.
  const Vec3 rounded = direction.cast<float>().cast<double>().normalized();
  const SurfaceSide fresh =
      evaluate_side(context.particles.body[row_of(stone)], rounded,
                    context.parameters.breakage.curvature_floor_ratio);
  const Vec3 &g = fresh.expansion.gradient;
  const Mat3 &h = fresh.expansion.hessian;
  side.direction.set(k, {direction.x(), direction.y(), direction.z()});
  side.radius[k] = fresh.expansion.radius;
  side.gradient.set(k, {g.x(), g.y(), g.z()});
  const double entries[6] = {h(0, 0), h(1, 1), h(2, 2),
                             h(0, 1), h(0, 2), h(1, 2)};
  for (std::size_t c = 0; c < 6; ++c)
    side.hessian[c][k] = static_cast<float>(entries[c]);
  side.curvature[k] = fresh.curvature;
  if (!batch.twist.empty())
    batch.twist[k] = not_mixed;
  if (batch.layout.has_damage)
    note_corner(batch, k, is_a);
}

void note_corner(ContactBatch &batch, std::size_t k, bool is_a)
{
  const SideColumns &side = is_a ? batch.side_a : batch.side_b;
  const unsigned bit = is_a ? 1u : 2u;
  const unsigned others = batch.corner[k] & ~bit;
  batch.corner[k] = static_cast<std::uint8_t>(
      others | (side.curvature[k].is_corner != 0 ? bit : 0u));
}

void forget_side(ContactBatch &batch, std::size_t k, bool is_a)
{
  if (!batch.layout.has_sides)
    return;
  SideColumns &side = is_a ? batch.side_a : batch.side_b;
  side.direction.set(k, {});
  side.radius[k] = 0.;
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
  const HertzPrefactors prefactors =
      elliptic_table()(context.elasticity, gap_coefficients(pair));
  batch.normal_prefactor[k] = prefactors.normal;
  batch.shear_prefactor[k] = prefactors.tangential;
  batch.twist[k] = 0.f;
}

bool find_damage(const ForceContext &context, ContactBatch &batch,
                 std::size_t k, double energy_before)
{
  const bool has_partner = batch.layout.has_partners;
  if (!batch.is_touching(k))
  {
    batch.event[k] = 0;
    batch.factor_a[k] = 0.;
    if (has_partner)
      batch.factor_b[k] = 0.;
    return false;
  }
  const DamageEnergy energy{batch.overlap[k], energy_before,
                            batch.history(k).normal_energy};
  const bool breaks_a =
      damage_side(context, batch.a[k], batch.side_a.curvature[k], energy,
                  batch.factor_a[k]);
  const bool breaks_b =
      has_partner && damage_side(context, batch.b[k], batch.side_b.curvature[k],
                                 energy, batch.factor_b[k]);
  batch.event[k] =
      static_cast<std::uint8_t>((breaks_a ? 1 : 0) | (breaks_b ? 2 : 0));
  return breaks_a || breaks_b;
}
} // namespace dem
