#include <dem/binary.h>
#include <dem/boundary/drum_boundary.h>
#include <dem/boundary/drum_contacts.h>
#include <dem/boundary/wall_point_lists.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace dem
{
void DrumBoundary::set_drum(const Drum &its_drum)
{
  drum = its_drum;
  lifter = DrumLifter(drum);
}

void DrumBoundary::move(double time_step)
{
  drum.angle += time_step * drum.spin;
  drum.radius += time_step * drum.widening;
  book(time_step);
}

double DrumBoundary::speed() const
{
  // Of a drum that turns the lifter alone comes nearer to a particle.
  const double rim = drum.lifter_height > 0. ? drum.spin * drum.radius : 0.;
  return std::sqrt(rim * rim + drum.widening * drum.widening);
}

double DrumBoundary::beyond(const Vec3 &point) const
{
  double most = -std::numeric_limits<double>::infinity();
  for (const DrumPart part :
       {DrumPart::cylinder, DrumPart::lower_end, DrumPart::upper_end})
    most = std::max(most, -nearest_on_drum(drum, part, point).distance);
  return most;
}

void DrumBoundary::find_candidates(const BoundarySearch &search)
{
  ContactPointSearchInput input = search.points;
  const ParticleSystem &particles = input.context.particles;
  const EngineParameters &parameters = input.context.parameters;
  input.layout = wall_layout(parameters, material, particles);
  if (!follows_surfaces(input.context))
  {
    rebuild_drum(particles, drum,
                 {input.layout, parameters.geometry.wall_geometry,
                  search.skin + input.layout.law.range()},
                 batch, rows, search.retired);
    return;
  }
  lifter.turn(drum);
  // Overlaps with a wall that was not there before count in full.
  input.is_first |= std::exchange(was_searched, true) == 0;
  search.events += renew_drum(input, {drum, lifter, search.rigid_path, rows},
                              listed, batch, search.retired);
}

void DrumBoundary::keep_contacts(const std::vector<std::int32_t> &order)
{
  name_by_part(batch);
  Boundary::keep_contacts(order);
  number_drum_contacts(order, batch, rows);
}

std::vector<std::int32_t> DrumBoundary::sort_contacts()
{
  name_by_part(batch);
  std::vector<std::int32_t> order = Boundary::sort_contacts();
  number_drum_contacts(order, batch, rows);
  return order;
}

void DrumBoundary::pack_contacts(
    std::ostream &out, const std::vector<std::int32_t> &contacts) const
{
  std::vector<WallRow> some;
  for (const std::int32_t k : contacts)
    some.push_back(
        rows[static_cast<std::size_t>(batch.b[static_cast<std::size_t>(k)])]);
  write_column(out, some);
}

void DrumBoundary::unpack_contacts(std::istream &in)
{
  std::vector<WallRow> more;
  read_column(in, more);
  rows.resize(batch.size() * static_cast<std::size_t>(n_drum_parts));
  const std::size_t first = batch.size() - more.size();
  for (std::size_t k = first; k < batch.size(); ++k)
  {
    batch.b[k] = n_drum_parts * static_cast<std::int32_t>(k) +
                 static_cast<std::int32_t>(drum_part(batch, k));
    rows[static_cast<std::size_t>(batch.b[k])] = more[k - first];
  }
}

void DrumBoundary::swap_contacts(Boundary &other)
{
  auto &another = static_cast<DrumBoundary &>(other);
  Boundary::swap_contacts(other);
  std::swap(rows, another.rows);
  std::swap(overlap, another.overlap);
  overlap.resize(rows.size()); // found again before they are read
}

void DrumBoundary::take_contact(std::size_t k, const Boundary &other,
                                std::size_t l)
{
  Boundary::take_contact(k, other, l);
  const auto &another = static_cast<const DrumBoundary &>(other);
  const auto row = static_cast<std::size_t>(batch.b[k]),
             from = static_cast<std::size_t>(another.batch.b[l]);
  rows[row] = another.rows[from];
  if (row < overlap.size() && from < another.overlap.size())
    overlap[row] = another.overlap[from];
}

ForceSum DrumBoundary::meet(const ForceContext &context)
{
  if (!follows_surfaces(context))
  {
    find_drum(context.particles, drum, batch, rows);
    return {};
  }
  lifter.turn(drum);
  return relocate_on_drum(context, followed(), batch);
}

Walls DrumBoundary::walls(const ForceContext &context)
{
  if (!follows_surfaces(context))
    return {material, rows};
  return {material,
          rows,
          overlap,
          {},
          [this](const ForceContext &still, std::size_t k)
          { relocate_again(still, followed(), batch, k); }};
}

BoundarySums DrumBoundary::sum_loads(const SumGrid &)
{
  load_sums = {};
  for (std::size_t k = 0; k < batch.size(); ++k)
  {
    const WallRow &row = rows[static_cast<std::size_t>(batch.b[k])];
    load_sums[0].add(torque_on_drum(drum, batch, k, row));
    load_sums[1].add(thrust_on_drum(batch, k, row));
  }
  return {load_sums};
}

void DrumBoundary::apply_loads(double time_step)
{
  drum.torque = load_sums[0].value();
  drum.thrust = load_sums[1].value();
  book(time_step);
}

/// Half a step with the forces as they are.
void DrumBoundary::book(double time_step)
{
  drum.work -=
      0.5 * time_step * (drum.torque * drum.spin + drum.thrust * drum.widening);
}

void DrumBoundary::pack_parts(std::ostream &out) const
{
  write_value(out, drum);
  write_column(out, rows);
  write_column(out, listed);
  write_value(out, was_searched);
}

void DrumBoundary::unpack_parts(std::istream &in)
{
  Drum read;
  read_value(in, read);
  set_drum(read);
  read_column(in, rows);
  read_column(in, listed);
  read_value(in, was_searched);
}
} // namespace dem
