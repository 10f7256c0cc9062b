#pragma once

#include "../row_of.h"
#include "force_kernels.h"

#include <dem/contact/forces.h>

#include <stdexcept>
#include <string>

namespace dem
{
/// Evaluates the surface of side A or B of contact k at a unit direction of the
/// body frame; its prefactors are out of date then.
void renew_side(const ForceContext &context, ContactBatch &batch, std::size_t k,
                bool is_a, const Vec3 &direction);

/// Sets ContactBatch::corner_a or corner_b of contact k from its curvature.
void note_corner(const ParticleSystem &particles, ContactBatch &batch,
                 std::size_t k, bool is_a);

/// Whether contacts of this geometry may break particles.
inline bool may_break(const BreakageParameters &breakage,
                      const GeometryTraits &geometry)
{
  return breakage.is_active &&
         (breakage.contacts == EventContacts::all || geometry.reads_shape);
}

/// Clears the surface data of side A or B of contact k.
void forget_side(ContactBatch &batch, std::size_t k, bool is_a);

/// C_H and k_s / sqrt(delta) of contact k from both sides as they lie to each
/// other across `normal`.
void mix_prefactors(const ForceContext &context, ContactBatch &batch,
                    std::size_t k, const Vec3 &normal);

/// The same against a rigid plate: from side A alone.
void set_wall_prefactors(const ForceContext &context, ContactBatch &batch,
                         std::size_t k);

/// Prefactors of two spheres, or of a sphere on a plate, for R = 1 m: C_H =
/// 4/3 E* sqrt(R), k_s / sqrt(delta) = 8 G* sqrt(R) with 1/G* =
/// sum (2 - nu_i) / G_i, from the elliptic solution of a circle, A = B =
/// 1 / (2 R).
inline HertzPrefactors unit_prefactors(const PairElasticity &elasticity)
{
  return elliptic_table()(elasticity, {0.5, 0.5});
}

/// A batch and what its rare work needs, as the loops pass it back.
struct SurfaceOwner
{
  const ForceContext &context;
  ContactBatch &batch;
  std::span<const WallRow> walls = {}; ///< that the contacts name
};

/// The surface data of one side as the loops see them.
kernel::Side side_view(SideColumns &side);

/// The columns as the loops see them; `owner` must outlive the task.
kernel::Task make_task(SurfaceOwner &owner,
                       const ContactCoefficients &coefficients);

/// The loop; throws std::invalid_argument where the law has none.
inline kernel::Loop required(kernel::Loop loop, const ContactLaw &law)
{
  if (!loop)
    throw std::invalid_argument("contact law " + law.name +
                                " attracts across gaps: it has no contacts of "
                                "true surfaces");
  return loop;
}

/// Runs a loop over all contacts of the owner, whose task it is, and adds its
/// loads to the particles.
ForceSum run_loop(kernel::Loop loop, const kernel::Task &task,
                  const SurfaceOwner &owner, std::vector<RangeSum> &ranges);

/// Runs a loop over contact k alone with no time passing; returns the energy
/// that its springs gave up [J]. `make` makes the task of a SurfaceOwner.
template <class MakeTask>
double run_still(const ForceContext &context, ContactBatch &batch,
                 std::size_t k, kernel::Loop loop, const MakeTask &make)
{
  ForceContext still = context;
  still.time_step = 0.;
  ContactBatch one = batch.extract(k);
  const double before = one.stored_energy(0);
  if (one.layout.has_partners)
    one.target[0] = one.b[0]; // anywhere that is there
  SurfaceOwner owner{still, one};
  RangeSum sum;
  loop(make(owner), 0, 1, sum);
  if (one.layout.has_partners)
    one.target[0] = batch.target[k];
  batch.replace(k, one);
  return before - one.stored_energy(0);
}
} // namespace dem
