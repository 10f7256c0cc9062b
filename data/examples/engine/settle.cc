// Spheres fall into a box and come to rest: their weight is on its floor.
#include <dem/control/box_servo.h>
#include <dem/engine_boundaries.h>

#include <cstdio>

int main()
{
  constexpr double radius = 5e-3, side = 0.06, gravity = 9.81; // m, m/s^2
  dem::EngineParameters parameters;
  parameters.particle.shear_modulus = 1e8;
  parameters.particle.friction = 0.5;
  parameters.particle.normal_damping = parameters.particle.shear_damping = 0.4;
  parameters.wall.normal_stiffness = 1e6;
  parameters.wall.shear_stiffness = 0.85e6;
  parameters.wall.normal_damping = parameters.wall.shear_damping = 0.4;
  parameters.gravity = {0., 0., -gravity};
  parameters.local_damping = 0.1;

  dem::Engine engine(parameters);
  const dem::BoxPlanes box =
      dem::add_box(engine, dem::Vec3::Zero(), {side, side, 0.2});
  double weight = 0.;
  for (int k = 0; k < 250; ++k)
  {
    const dem::Vec3 site(k % 5 + 0.5 + 0.03 * (k % 3), k / 5 % 5 + 0.5,
                         k / 25 + 0.5);
    engine.add_particle(dem::make_sphere(radius), 0.2 * side * site,
                        dem::Quaternion::Identity());
    weight += gravity * engine.particles().mass(static_cast<std::size_t>(k));
  }

  constexpr double time_step = 1e-5; // s
  for (int step = 0; step < 100000; ++step)
    engine.advance(time_step);

  const double on_floor = -dem::planes(engine)[box[2][0]].force.z();
  std::printf("weight %.4f N, on the floor %.4f N, after %.2f s\n", weight,
              on_floor, engine.time());
  return std::abs(on_floor - weight) < 0.01 * weight ? 0 : 1;
}
