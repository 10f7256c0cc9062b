#include <dem/binary.h>
#include <dem/boundary/drum_boundary.h>
#include <dem/boundary/drum_contacts.h>
#include <dem/boundary/renumber.h>
#include <dem/boundary/wall_point_lists.h>

#include <algorithm>
#include <cmath>

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
                 batch, search.retired);
    return;
  }
  lifter.turn(drum);
  search.events += renew_drum(input, {drum, lifter, search.rigid_path, rows},
                              listed, batch, search.retired);
}

void DrumBoundary::renumber(const std::vector<std::int32_t> &new_row,
                            bool follows_surfaces)
{
  renumber_candidates(new_row, listed);
  if (follows_surfaces)
    renumber_drum_contacts(new_row, batch, rows);
  else
    renumber_planes(new_row, batch);
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

void DrumBoundary::apply_loads(double time_step)
{
  drum.torque = drum_torque(drum, batch, rows);
  drum.thrust = drum_thrust(batch, rows);
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
}

void DrumBoundary::unpack_parts(std::istream &in)
{
  Drum read;
  read_value(in, read);
  set_drum(read);
  read_column(in, rows);
  read_column(in, listed);
}
} // namespace dem
