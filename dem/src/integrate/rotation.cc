#include <dem/integrate/rotation.h>

#include <cmath>

namespace dem
{
namespace
{
/// Cosine and sine of half an angle over the angle: sin(x/2) / x.
struct HalfAngle
{
  double cosine = 1., factor = 0.5;
};

HalfAngle half_angle(double square)
{
  const double half_square = 0.25 * square;
  if (half_square < 2.5e-3) // the next terms are below 1e-15
    return {1. - half_square *
                     (1. / 2. -
                      half_square * (1. / 24. - half_square * (1. / 720.))),
            0.5 - half_square *
                      (1. / 12. - half_square * (1. / 240. -
                                                 half_square * (1. / 10080.)))};
  const double half = std::sqrt(half_square);
  return {std::cos(half), 0.5 * std::sin(half) / half};
}

/// A rotation about principal axis d at the rate that its momentum has; the
/// body sees the momentum turn back.
template <int d>
void turn_about(double time_step, const Vec3 &moments, Vec3 &momentum,
                Quaternion &to_world)
{
  constexpr int e = (d + 1) % 3, f = (d + 2) % 3;
  const double angle = time_step * momentum[d] / moments[d];
  const HalfAngle half = half_angle(angle * angle);
  const double c = half.cosine, s = half.factor * angle;
  const double cosine = 1. - 2. * s * s, sine = 2. * c * s;
  const double along_e = momentum[e], along_f = momentum[f];
  momentum[e] = cosine * along_e + sine * along_f;
  momentum[f] = cosine * along_f - sine * along_e;
  const Quaternion q = to_world;
  to_world.w() = c * q.w() - s * q.vec()[d];
  to_world.vec()[d] = c * q.vec()[d] + s * q.w();
  to_world.vec()[e] = c * q.vec()[e] + s * q.vec()[f];
  to_world.vec()[f] = c * q.vec()[f] - s * q.vec()[e];
}
} // namespace

Quaternion exponential(const Vec3 &rotation)
{
  const HalfAngle half = half_angle(rotation.squaredNorm());
  const Vec3 axis = half.factor * rotation;
  return {half.cosine, axis.x(), axis.y(), axis.z()};
}

void turn_freely(Rotor &rotor, double time_step)
{
  Vec3 momentum =
      rotor.moments.cwiseProduct(rotor.to_world.conjugate() * rotor.spin);
  const double half = 0.5 * time_step;
  turn_about<0>(half, rotor.moments, momentum, rotor.to_world);
  turn_about<1>(half, rotor.moments, momentum, rotor.to_world);
  turn_about<2>(time_step, rotor.moments, momentum, rotor.to_world);
  turn_about<1>(half, rotor.moments, momentum, rotor.to_world);
  turn_about<0>(half, rotor.moments, momentum, rotor.to_world);
  rotor.to_world.normalize();
  rotor.spin = rotor.to_world * momentum.cwiseQuotient(rotor.moments);
}
} // namespace dem
