#include "follow.h"

#include <dem/contact/pair_loads.h>

#include <algorithm>

namespace dem
{
namespace
{
SurfaceOwner &owner_of(void *owner)
{
  return *static_cast<SurfaceOwner *>(owner);
}

void renew(void *owner, std::int64_t k, int side, const double *direction)
{
  ContactBatch &batch = owner_of(owner).batch;
  const auto contact = static_cast<std::size_t>(k);
  const SideColumns &columns = side == 0 ? batch.side_a : batch.side_b;
  renew_side(owner_of(owner).context, batch, contact, side == 0,
             direction ? Vec3(Eigen::Map<const Vec3>(direction))
                       : columns.contact_point(contact));
}

void mix(void *owner, std::int64_t k, const double *normal)
{
  mix_prefactors(owner_of(owner).context, owner_of(owner).batch,
                 static_cast<std::size_t>(k), Eigen::Map<const Vec3>(normal));
}

double relocate(void *owner, std::int64_t k, RangeSum *sum)
{
  const SurfaceOwner &of = owner_of(owner);
  const auto contact = static_cast<std::size_t>(k);
  if (of.batch.layout.has_partners)
    return relocate_pair(of.context, of.batch, contact, *sum);
  relocate_wall(of.context, of.batch, contact,
                of.walls[row_of(of.batch.b[contact])], *sum);
  return 0.;
}

template <class Row>
auto *numbers(std::vector<Row> &rows)
{
  static_assert(sizeof(Row) % sizeof(double) == 0);
  return reinterpret_cast<double *>(rows.data());
}

kernel::Contacts contacts_view(ContactBatch &batch)
{
  const auto vectors = []<class Number>(TripleColumn<Number> &column)
  {
    return kernel::Vectors<Number>{column.x.data(), column.y.data(),
                                   column.z.data()};
  };
  return {batch.a.data(),
          batch.b.data(),
          vectors(batch.shear),
          vectors(batch.rolling),
          vectors(batch.dashpot),
          numbers(batch.load),
          batch.target.data(),
          batch.overlap.data(),
          batch.reactivation.data(),
          batch.normal_force.data(),
          batch.shear_compliance.data(),
          batch.rolling_compliance.data(),
          side_view(batch.side_a),
          side_view(batch.side_b),
          batch.normal_prefactor.data(),
          batch.shear_prefactor.data(),
          batch.torsion_angle.data(),
          batch.overlap_offset.data(),
          batch.factor_a.data(),
          batch.factor_b.data(),
          batch.corner_a.data(),
          batch.corner_b.data(),
          batch.reversal.data(),
          batch.peak.data(),
          batch.event.data(),
          batch.normal_energy.data(),
          batch.attraction.data(),
          batch.reduced_radius.data()};
}

/// Contacts up to this many bytes stay in the caches: asking ahead only costs.
constexpr std::size_t cached_bytes = std::size_t{4} << 20;

/// Whether a column is one of some vectors.
template <class... Columns>
bool is_any_of(const void *column, const Columns &...vectors)
{
  return ((column == vectors.x.data() || column == vectors.y.data() ||
           column == vectors.z.data()) ||
          ...);
}

/// All but what is read rarely.
kernel::ColumnsAhead columns_ahead(ContactBatch &batch)
{
  kernel::ColumnsAhead ahead;
  std::size_t bytes = 0;
  const auto is_rare = [&batch](const void *column)
  {
    return column == batch.factor_a.data() || column == batch.factor_b.data() ||
           column == batch.event.data() ||
           (batch.layout.has_contact_points &&
            is_any_of(column, batch.side_a.direction, batch.side_b.direction));
  };
  const auto add = [&]<class Entry>(bool is_there, std::vector<Entry> &column)
  {
    if (!is_there || std::is_same_v<Entry, SideCurvature> ||
        is_rare(column.data()))
      return;
    ahead.start[ahead.n] = reinterpret_cast<const char *>(column.data());
    ahead.entry_size[ahead.n++] = sizeof(Entry);
    bytes += column.size() * sizeof(Entry);
  };
  ContactBatch::visit(batch.layout, add, batch);
  if (bytes < cached_bytes)
    ahead.n = 0;
  return ahead;
}

static_assert(sizeof(ParticleState) == kernel::particle_row * sizeof(double));
static_assert(sizeof(ParticleLoad) == kernel::load_row * sizeof(double));

kernel::ParticleSystem particles_view(const ForceContext &context)
{
  ParticleSystem &particles = context.particles;
  return {numbers(particles.state),
          particles.has_shapes ? particles.path_length.data() : nullptr,
          context.gap_path,
          context.cell_path,
          numbers(particles.load),
          nullptr};
}
} // namespace

kernel::Side side_view(SideColumns &side)
{
  const auto vectors = [](const TripleColumn<Narrow> &column)
  {
    return kernel::Vectors<const Narrow>{column.x.data(), column.y.data(),
                                         column.z.data()};
  };
  kernel::Side view{vectors(side.direction),
                    side.radius.data(),
                    vectors(side.gradient),
                    {},
                    vectors(side.normal),
                    side.height.data(),
                    {side.aside.x.data(), side.aside.y.data()},
                    {},
                    {side.offset.x.data(), side.offset.y.data()}};
  for (std::size_t c = 0; c < 6; ++c)
    view.hessian[c] = side.hessian[c].data();
  for (std::size_t c = 0; c < 3; ++c)
    view.shape_operator[c] = side.shape_operator[c].data();
  return view;
}

kernel::Task make_task(SurfaceOwner &owner,
                       const ContactCoefficients &coefficients)
{
  const ForceContext &context = owner.context;
  kernel::Task task{};
  task.particles = particles_view(context);
  task.contacts = contacts_view(owner.batch);
  task.ahead = columns_ahead(owner.batch);
  task.surfaces = {&owner, renew, mix, relocate};
  task.coefficients = coefficients;
  task.coefficients.limit_damping =
      context.parameters.friction_limit == FrictionLimit::total ? 1. : 0.;
  task.time_step = context.time_step;
  task.law = owner.batch.layout.law.values;
  task.range = owner.batch.layout.law.range();
  task.refresh_tolerance = context.parameters.geometry.refresh_tolerance;
  task.reads_surface = owner.batch.layout.has_sides;
  // A still contact takes no damage.
  task.has_damage = owner.batch.layout.has_damage && context.time_step > 0.;
  task.fracture_energy = context.parameters.breakage.fracture_energy;
  task.repetitions = context.parameters.breakage.repetitions;
  task.hysteresis = context.parameters.breakage.hysteresis;
  task.counts_shear =
      context.parameters.breakage.energy == CriterionEnergy::with_shear;
  task.keeps_factors =
      context.parameters.breakage.memory == FactorMemory::patch;
  task.force_shift = rounding_shift(context.grid.force);
  task.moment_shift = rounding_shift(context.grid.moment);

  task.adds_loads_only = context.adds_loads_only;
  const PeriodicCell &cell = context.particles.cell;
  task.is_periodic = cell.is_there();
  Vec3::Map(task.cell_length) = cell.length;
  Vec3::Map(task.cell_rate) = cell.rate;
  return task;
}

ForceSum &ForceSum::operator+=(const ForceSum &part)
{
  lost += part.lost;
  largest_force = std::max(largest_force, part.largest_force);

  wants_breakage |= part.wants_breakage;
  has_displaced |= part.has_displaced;
  has_switched |= part.has_switched;
  n_jumps += part.n_jumps;
  n_ended += part.n_ended;
  overlap_ratio = std::max(overlap_ratio, part.overlap_ratio);
  cell_force += part.cell_force;
  return *this;
}

ForceSum run_loop(kernel::Loop loop, const kernel::Task &task,
                  const SurfaceOwner &owner, std::vector<RangeSum> &ranges)
{
  const auto n_contacts = static_cast<std::int64_t>(owner.batch.size());
  const std::int64_t size = range_size(n_contacts);
  const std::int64_t n_ranges = (n_contacts + size - 1) / size;
  ranges.assign(static_cast<std::size_t>(n_ranges), RangeSum{});
  // A few contacts are done sooner than threads are woken.
#pragma omp parallel for schedule(static) if (n_contacts >= 256)
  for (std::int64_t r = 0; r < n_ranges; ++r)
  {
    const std::int64_t first = r * size,
                       last = std::min(first + size, n_contacts);
    RangeSum &range = ranges[static_cast<std::size_t>(r)];
    loop(task, first, last, range);
    // While the contacts are in the caches.
    range.overlap_ratio = largest_overlap_ratio(
        {owner.batch, owner.context.particles, owner.context.known_overlap},
        static_cast<std::size_t>(first), static_cast<std::size_t>(last));
  }
  ForceSum sum;

  for (std::int64_t r = 0; r < n_ranges; ++r)
  {
    const RangeSum &range = ranges[static_cast<std::size_t>(r)];
    double *row = task.particles.load +
                  kernel::load_row * std::int64_t{task.contacts.a[r * size]};
    for (int c = 0; c < 6; ++c)
      row[c] += range.load[c];
    sum.lost += range.lost;
    sum.lost += range.lost_rest;
    sum.largest_force = std::max(sum.largest_force, range.largest_force);

    sum.wants_breakage |= range.wants_breakage;
    sum.has_switched |= range.has_switched;
    sum.has_displaced |= range.has_displaced;
    sum.n_jumps += range.n_jumps;
    sum.n_ended += range.n_ended;
    sum.overlap_ratio = std::max(sum.overlap_ratio, range.overlap_ratio);
    sum.cell_force += Eigen::Map<const Vec3>(range.cell_force);
  }
  return sum;
}
} // namespace dem
