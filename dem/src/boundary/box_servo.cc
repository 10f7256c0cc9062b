#include <dem/boundary/box_servo.h>
#include <dem/io/binary.h>

#include <algorithm>

namespace dem
{
namespace
{
double face_area(const Vec3 &size, int axis)
{
  return size[(axis + 1) % 3] * size[(axis + 2) % 3];
}
} // namespace

BoxPlanes add_box(Engine &engine, const Vec3 &lower, const Vec3 &upper)
{
  BoxPlanes planes;
  for (int d = 0; d < 3; ++d)
    planes[static_cast<std::size_t>(d)] = {
        engine.add_plane(lower, Vec3::Unit(d)),
        engine.add_plane(upper, -Vec3::Unit(d))};
  return planes;
}

Vec3 box_size(const Engine &engine, const BoxPlanes &planes)
{
  Vec3 size;
  for (int d = 0; d < 3; ++d)
  {
    const auto &[lower, upper] = planes[static_cast<std::size_t>(d)];
    size[d] = engine.planes()[upper].point[d] - engine.planes()[lower].point[d];
  }
  return size;
}

Vec3 box_stress(const Engine &engine, const BoxPlanes &planes)
{
  const Vec3 size = box_size(engine, planes);
  Vec3 stress;
  for (int d = 0; d < 3; ++d)
  {
    const auto &[lower, upper] = planes[static_cast<std::size_t>(d)];
    stress[d] =
        0.5 *
        (engine.planes()[upper].force[d] - engine.planes()[lower].force[d]) /
        face_area(size, d);
  }
  return stress;
}

BoxServo::BoxServo(const BoxPlanes &box, const ServoParameters &servo)
    : planes(box), parameters(servo)
{
}

void BoxServo::follow(int d, double stress)
{
  is_on[static_cast<std::size_t>(d)] = true;
  target[d] = stress;
}

void BoxServo::release(Engine &engine, int d)
{
  is_on[static_cast<std::size_t>(d)] = false;
  for (const std::size_t plane : planes[static_cast<std::size_t>(d)])
    engine.planes()[plane].velocity = Vec3::Zero();
}

void BoxServo::update(Engine &engine, double time_step)
{
  if (engine.n_steps() % 20 == 0)
    stiffness = affine_stiffness(engine.particles(), engine.pairs());
  const Vec3 size = box_size(engine, planes);
  const double share = std::min(1., 5. * time_step / parameters.response_time);
  average += share * (box_stress(engine, planes) - average);
  for (int d = 0; d < 3; ++d)
  {
    if (!is_on[static_cast<std::size_t>(d)])
      continue;
    const double area = face_area(size, d);
    const double per_length =
        std::max(stiffness[d] / (size[d] * size[d]),
                 50. * std::abs(target[d]) * area / size[d]);
    const double wanted =
        0.5 * (target[d] - average[d]) * area /
        std::max(per_length * parameters.response_time, 1e-12);
    const double speed =
        std::clamp(wanted, -parameters.max_speed, parameters.max_speed);
    const auto &[lower, upper] = planes[static_cast<std::size_t>(d)];
    engine.planes()[lower].velocity = speed * Vec3::Unit(d);
    engine.planes()[upper].velocity = -speed * Vec3::Unit(d);
  }
}

void BoxServo::save(std::ostream &out) const
{
  write_value(out, is_on);
  write_value(out, target);
  write_value(out, average);
  write_value(out, stiffness);
}

void BoxServo::restore(std::istream &in)
{
  read_value(in, is_on);
  read_value(in, target);
  read_value(in, average);
  read_value(in, stiffness);
}
} // namespace dem
