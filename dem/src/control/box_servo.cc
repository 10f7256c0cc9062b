#include <dem/binary.h>
#include <dem/control/box_servo.h>
#include <dem/engine_boundaries.h>
#include <dem/measure/assembly.h>
#include <dem/parallel/distribution.h>

#include <algorithm>
#include <numbers>

namespace dem
{
namespace
{
/// Steps that a wall takes through the skin of the lists at least: lists are
/// made for more than one of them.
constexpr double steps_in_skin = 10.;

double face_area(const Vec3 &size, int axis)
{
  return size[(axis + 1) % 3] * size[(axis + 2) % 3];
}

/// Of a cylinder.
double side_area(const Vec3 &size)
{
  return std::numbers::pi * size.x() * size.z();
}
} // namespace

BoxPlanes add_box(Engine &engine, const Vec3 &lower, const Vec3 &upper)
{
  BoxPlanes planes;
  for (int d = 0; d < 3; ++d)
    planes[static_cast<std::size_t>(d)] = {
        add_plane(engine, lower, Vec3::Unit(d)),
        add_plane(engine, upper, -Vec3::Unit(d))};
  return planes;
}

SpecimenWalls add_cylinder(Engine &engine, const Vec3 &lower, const Vec3 &upper)
{
  BoxPlanes planes{};
  planes[2] = {add_plane(engine, lower, Vec3::UnitZ()),
               add_plane(engine, upper, -Vec3::UnitZ())};
  const Vec3 size = upper - lower;
  Drum side;
  side.centre = 0.5 * (lower + upper);
  side.axis = Vec3::UnitZ();
  side.radius = 0.5 * size.x();
  side.length = 1e3 * size.norm();
  set_drum(engine, side);
  return {planes, EnclosureForm::cylinder};
}

SpecimenWalls add_periodic_cell(Engine &engine, const Vec3 &lower,
                                const Vec3 &upper,
                                const std::array<bool, 3> &axes)
{
  SpecimenWalls walls;
  Vec3 length = upper - lower;
  for (int d = 0; d < 3; ++d)
  {
    const auto axis = static_cast<std::size_t>(d);
    if (axes[axis])
      continue;
    length[d] = 0.;
    walls.planes[axis] = {add_plane(engine, lower, Vec3::Unit(d)),
                          add_plane(engine, upper, -Vec3::Unit(d))};
  }
  engine.set_periodic_cell(0.5 * (lower + upper), length);
  return walls;
}

std::pair<Vec3, Vec3> box_corners(const Engine &engine,
                                  const SpecimenWalls &walls)
{
  const PeriodicCell &cell = engine.cell();
  const Drum &side = drum(engine);
  Vec3 lower, upper;
  for (int d = 0; d < 3; ++d)
    if (walls.is_round() && d < 2)
    {
      lower[d] = side.centre[d] - side.radius;
      upper[d] = side.centre[d] + side.radius;
    }
    else if (cell.is_periodic(d))
    {
      lower[d] = cell.centre[d] - 0.5 * cell.length[d];
      upper[d] = cell.centre[d] + 0.5 * cell.length[d];
    }
    else
    {
      const auto &[low, high] = walls.planes[static_cast<std::size_t>(d)];
      lower[d] = planes(engine)[low].point[d];
      upper[d] = planes(engine)[high].point[d];
    }
  return {lower, upper};
}

Vec3 box_size(const Engine &engine, const SpecimenWalls &walls)
{
  const auto [lower, upper] = box_corners(engine, walls);
  return upper - lower;
}

double box_section(const Engine &engine, const SpecimenWalls &walls)
{
  const Vec3 size = box_size(engine, walls);
  return (walls.is_round() ? 0.25 * std::numbers::pi : 1.) * size.x() *
         size.y();
}

double box_volume(const Engine &engine, const SpecimenWalls &walls)
{
  return box_section(engine, walls) * box_size(engine, walls).z();
}

Vec3 box_stress(const Engine &engine, const SpecimenWalls &walls)
{
  const Vec3 size = box_size(engine, walls);
  const PeriodicCell &cell = engine.cell();
  Vec3 stress;
  for (int d = 0; d < 3; ++d)
    if (walls.is_round() && d < 2)
      stress[d] = drum(engine).thrust / side_area(size);
    else if (cell.is_periodic(d))
      stress[d] = cell.stress(d, face_area(size, d));
    else
    {
      const auto &[lower, upper] = walls.planes[static_cast<std::size_t>(d)];
      const double area =
          d == 2 ? box_section(engine, walls) : face_area(size, d);
      stress[d] =
          0.5 *
          (planes(engine)[upper].force[d] - planes(engine)[lower].force[d]) /
          area;
    }
  return stress;
}

BoxServo::BoxServo(const SpecimenWalls &of_specimen,
                   const ServoParameters &servo)
    : walls(of_specimen), parameters(servo)
{
}

void BoxServo::follow(int d, double stress)
{
  const auto axis = static_cast<std::size_t>(d);
  if (is_moved[axis])
    summed[d] = 0.;
  is_moved[axis] = false;
  is_on[axis] = true;
  target[d] = stress;
}

void BoxServo::move(int d, double shortening_rate)
{
  is_moved[static_cast<std::size_t>(d)] = true;
  rate[d] = shortening_rate;
}

void BoxServo::release(Engine &engine, int d)
{
  is_on[static_cast<std::size_t>(d)] = false;
  is_moved[static_cast<std::size_t>(d)] = false;
  set_speed(engine, d, 0.);
}

void BoxServo::set_speed(Engine &engine, int d, double inward) const
{
  if (engine.cell().is_periodic(d))
  {
    Vec3 of_cell = engine.cell().rate;
    of_cell[d] = -2. * inward;
    engine.set_cell_rate(of_cell);
    return;
  }
  if (walls.is_round() && d < 2)
  {
    if (d == 0)
      drum(engine).widening = -inward;
    return;
  }
  const auto &[lower, upper] = walls.planes[static_cast<std::size_t>(d)];
  planes(engine)[lower].velocity = inward * Vec3::Unit(d);
  planes(engine)[upper].velocity = -inward * Vec3::Unit(d);
}

BoxServo::Pair BoxServo::pair(const Engine &engine, int d) const
{
  const Vec3 size = box_size(engine, walls);
  // With equal strains along x and y a contact gives at most twice the sum.
  if (walls.is_round() && d < 2)
    return {side_area(size), 0.5 * size.x(), 1.,
            2. * (stiffness.x() + stiffness.y())};
  return {d == 2 ? box_section(engine, walls) : face_area(size, d), size[d], 2.,
          stiffness[d]};
}

/// At which the ends come together, over their distance [1/s].
double BoxServo::rate_of_load(const Engine &engine) const
{
  if (engine.cell().is_periodic(2))
    return -engine.cell().rate.z() / engine.cell().length.z();
  const auto &[lower, upper] = walls.planes[2];
  return (planes(engine)[lower].velocity.z() -
          planes(engine)[upper].velocity.z()) /
         box_size(engine, walls).z();
}

/// What is left of the error beside the dead band [Pa].
double BoxServo::heeded_error(int d) const
{
  const double error = target[d] - average[d];
  if (!follows_load)
    return error;
  const double band = parameters.dead_band * std::abs(target[d]);
  return error - std::clamp(error, -band, band);
}

void BoxServo::update(Engine &engine, double time_step)
{
  if (engine.n_steps() % 20 == 0)
    stiffness = affine_stiffness(engine.particles(), engine.pairs(),
                                 engine.distribution().ranks());
  const double share = std::min(1., 5. * time_step / parameters.response_time);
  average += share * (box_stress(engine, walls) - average);
  for (int d = 0; d < 3; ++d)
  {
    const auto axis = static_cast<std::size_t>(d);
    if (!is_on[axis] && !is_moved[axis])
      continue;
    const Pair moved = pair(engine, d);
    if (is_moved[axis])
    {
      set_speed(engine, d, rate[d] * moved.length / moved.n_moving);
      continue;
    }
    const double per_length =
        std::max(moved.stiffness / (moved.length * moved.length),
                 50. * std::abs(target[d]) * moved.area / moved.length);
    const double error = heeded_error(d);
    double wanted = (error + summed[d]) * moved.area / moved.n_moving /
                    std::max(per_length * parameters.response_time, 1e-12);
    if (follows_load && d < 2)
      wanted -= parameters.yielding * rate_of_load(engine) * moved.length /
                moved.n_moving;
    const double fastest = std::min(
        parameters.speed_share[d] * parameters.max_speed,
        engine.parameters().geometry.usual_skin / (steps_in_skin * time_step));
    // A wall that is as fast as it may be would only sum up its delay.
    if (follows_load && std::abs(wanted) < fastest)
      summed[d] += 0.5 * time_step / parameters.response_time * error;
    set_speed(engine, d, std::clamp(wanted, -fastest, fastest));
  }
}

void BoxServo::save(std::ostream &out) const
{
  write_value(out, is_on);
  write_value(out, target);
  write_value(out, average);
  write_value(out, stiffness);
  write_value(out, follows_load);
  write_value(out, summed);
  write_value(out, is_moved);
  write_value(out, rate);
}

void BoxServo::restore(std::istream &in)
{
  read_value(in, is_on);
  read_value(in, target);
  read_value(in, average);
  read_value(in, stiffness);
  read_value(in, follows_load);
  read_value(in, summed);
  read_value(in, is_moved);
  read_value(in, rate);
}
} // namespace dem
