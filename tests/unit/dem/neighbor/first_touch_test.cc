#include "dem_scene.h"
#include "wall_meshes.h"

#include <dem/boundary/wall_contact_points.h>
#include <dem/engine_boundaries.h>
#include <dem/neighbor/contact_points.h>
#include <dem/random.h>
#include <dem/shape/radius_bounds.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <shape/test_shapes.h>

// Needles and plates between 2:1 and 20:1, as series of order 8 to 30: bounds
// and first touch against a search of dense points that knows nothing but r(s).
// The geometry is that of the series, also where it is a poor ellipsoid.
namespace
{
using dem::ParticleShape;
using dem::Vec3;

struct Form
{
  double ratio = 1.;
  int order = 0;
  bool is_plate = false;
  int turn = 0; ///< 0: the axis is that of the maps
};

void PrintTo(const Form &form, std::ostream *out)
{
  *out << (form.is_plate ? "plate " : "needle ") << form.ratio << ":1 order "
       << form.order << " turn " << form.turn;
}

/// Short half axis 5 mm of a needle, 10 mm long half axis of a plate at 2:1.
std::vector<double> series_of(const Form &form)
{
  const Vec3 axes = form.is_plate ? Vec3(form.ratio, form.ratio, 1.)
                                  : Vec3(1., 1., form.ratio);
  dem::Random random(static_cast<std::uint64_t>(form.turn));
  const dem::Mat3 back = form.turn == 0 ? dem::Mat3(dem::Mat3::Identity())
                                        : random.rotation().toRotationMatrix();
  return dem::test::project(
      form.order, [&](const Vec3 &s)
      { return 5e-3 * dem::test::ellipsoid_radius(axes, back * s); });
}

/// Directions over a surface and their radii, to search by brute force.
class DensePoints
{
public:
  DensePoints(const ParticleShape &of, int n_rings)
      : body(of), rule(dem::sphere_rule(n_rings)),
        radii(dem::node_radii(*of.series, rule))
  {
  }

  double radius(const Vec3 &s) const
  {
    return body.scale * dem::radius(*body.series, s);
  }

  /// Smallest value(x) over the surface: the best points, followed by steps in
  /// eight directions.
  template <class Value>
  double least(const Value &value, Vec3 *where = nullptr) const
  {
    constexpr std::size_t n_starts = 12;
    std::vector<std::pair<double, std::size_t>> all(radii.size());
    for (std::size_t k = 0; k < radii.size(); ++k)
      all[k] = {value(Vec3(body.scale * radii[k] * rule.direction[k])), k};
    std::partial_sort(all.begin(), all.begin() + n_starts, all.end());
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t n = 0; n < n_starts; ++n)
    {
      Vec3 at = rule.direction[all[n].second];
      double lowest = all[n].first;
      for (double step = 0.02; step > 1e-6;)
        if (!improve(value, step, at, lowest))
          step *= 0.5;
      if (lowest < best && where)
        *where = at;
      best = std::min(best, lowest);
    }
    return best;
  }

private:
  template <class Value>
  bool improve(const Value &value, double step, Vec3 &at, double &lowest) const
  {
    const dem::test::Tangents frame = dem::test::tangents(at);
    for (int k = 0; k < 8; ++k)
    {
      const double angle = 0.25 * std::numbers::pi * k;
      const Vec3 to = (at + step * (std::cos(angle) * frame.first +
                                    std::sin(angle) * frame.second))
                          .normalized();
      if (const double there = value(Vec3(radius(to) * to)); there < lowest)
      {
        lowest = there;
        at = to;
        return true;
      }
    }
    return false;
  }

  const ParticleShape &body;
  const dem::SphereQuadrature &rule;
  std::vector<double> radii;
};

struct Particle
{
  ParticleShape body;
  dem::RadiusMap map;
  DensePoints dense;
  double mean;

  explicit Particle(const Form &form)
      : body(dem::shape_of(series_of(form))), map(body.series),
        dense(body, 100), mean(dem::mean_radius(body))
  {
  }
  Particle(const Particle &) = delete;

  dem::MappedParticle mapped() const { return {body, map}; }
  double height(const Vec3 &direction) const
  {
    return -dense.least([&](const Vec3 &x) { return -x.dot(direction); });
  }
  dem::MappedParticlePose
  at(const Vec3 &position,
     const dem::Mat3 &rotation = dem::Mat3::Identity()) const
  {
    return {mapped(), position, rotation};
  }
};

/// Along the axes, near them, and anywhere.
std::vector<Vec3> directions_for(const Particle &particle)
{
  Vec3 far, near;
  particle.dense.least([](const Vec3 &x) { return -x.norm(); }, &far);
  particle.dense.least([](const Vec3 &x) { return x.norm(); }, &near);
  std::vector<Vec3> all = {far, near};
  for (const Vec3 &s : dem::test::random_directions(4, 8))
    for (const Vec3 &about : {far, near, Vec3(Vec3::Zero())})
      all.push_back((about + (about.isZero() ? 1. : 0.1) * s).normalized());
  return all;
}

void expect_bounds(const Particle &particle)
{
  const double largest =
      -particle.dense.least([](const Vec3 &x) { return -x.norm(); });
  const double smallest =
      particle.dense.least([](const Vec3 &x) { return x.norm(); });
  EXPECT_GE(particle.body.circumscribed_radius, (1. - 1e-9) * largest);
  EXPECT_LE(particle.body.circumscribed_radius, 1.006 * largest);
  EXPECT_LE(particle.body.least_radius, (1. + 1e-9) * smallest);
  EXPECT_GE(particle.body.least_radius, smallest - 0.006 * largest);
  const dem::SphereQuadrature &rule = dem::sphere_rule(100);
  std::vector<dem::RadialExpansion> all(rule.direction.size());
  dem::expand(*particle.body.series, rule.direction, all);
  double steepest = 0.;
  for (const dem::RadialExpansion &at : all)
    steepest = std::max(steepest, at.gradient.norm());
  EXPECT_GE(particle.body.max_slope, steepest);
  EXPECT_LE(particle.body.max_slope, 1.1 * steepest);
}

// What the pattern search leaves, and the sharpest tips in single precision.
constexpr double tolerance = 1e-5;

void expect_supports(const Particle &particle)
{
  for (const Vec3 &n : directions_for(particle))
  {
    const double height = particle.height(n);
    EXPECT_GE(particle.map.height(n).height + particle.map.sag(),
              height - tolerance * particle.mean);
    const auto found = dem::find_supports(
        particle.mapped(), n, {height - 0.02 * particle.mean, height});
    ASSERT_FALSE(found.empty()) << n.transpose();
    EXPECT_NEAR(found[0].overlap / particle.mean, 0., tolerance)
        << n.transpose();
  }
}

void expect_drum(const Particle &particle)
{
  const double gap = 0.01 * particle.mean;
  for (const Vec3 &axis : dem::test::random_directions(3, 5))
  {
    dem::Drum drum;
    drum.axis = axis;
    drum.centre = 0.5 * particle.mean * axis.unitOrthogonal();
    drum.length = 1.;
    const auto from_axis = [&](const Vec3 &x)
    { return (x - drum.centre).cross(axis).norm(); };
    drum.radius = gap - particle.dense.least([&](const Vec3 &x)
                                             { return -from_axis(x); });
    const auto round = dem::find_on_drum(particle.at(Vec3::Zero()), drum,
                                         dem::DrumPart::cylinder, 3. * gap);
    ASSERT_FALSE(round.contact_points.empty()) << axis.transpose();
    EXPECT_NEAR(round.contact_points[0].overlap, -gap,
                tolerance * particle.mean);
    drum.radius = 1.;
    drum.centre = Vec3::Zero();
    drum.length = 2. * (particle.height(axis) + gap);
    const auto end = dem::find_on_drum(particle.at(Vec3::Zero()), drum,
                                       dem::DrumPart::upper_end, 3. * gap);
    ASSERT_FALSE(end.contact_points.empty()) << axis.transpose();
    EXPECT_NEAR(end.contact_points[0].overlap, -gap, tolerance * particle.mean);
  }
}

void expect_facets(const Particle &particle)
{
  // Triangles about as large as the particle is wide, hills and hollows.
  const support::WallMesh mesh = support::flat_wall(particle.mean, 12, 0.25);
  std::vector<std::int32_t> all(mesh.surface.triangles.size());
  std::iota(all.begin(), all.end(), 0);
  dem::Random random(11);
  const DensePoints dense(particle.body, 48);
  for (int pose = 0; pose < 2; ++pose)
  {
    const dem::Mat3 rotation = random.rotation().toRotationMatrix();
    Vec3 centre(0., 0., 0.);
    const auto distance = [&](const Vec3 &x)
    {
      const Vec3 in_world = centre + rotation * x;
      double nearest = std::numeric_limits<double>::infinity();
      for (const std::int32_t t : all)
        nearest = std::min(
            nearest,
            (dem::nearest_point(in_world, dem::corners_of(mesh.surface, t))
                 .point -
             in_world)
                .squaredNorm());
      return std::sqrt(nearest);
    };
    centre.z() =
        particle.height(-rotation.row(2).transpose()) + 0.3 * particle.mean;
    centre.z() -= dense.least(distance) - 0.02 * particle.mean;
    const double gap = dense.least(distance);
    const auto found =
        dem::find_on_facets(particle.at(centre, rotation), mesh.view(), all,
                            gap + 0.02 * particle.mean);
    ASSERT_FALSE(found.contact_points.empty()) << pose;
    // The dense points may miss the nearest contact point, which is then
    // checked alone.
    const dem::WallContactPoint &contact_point = found.contact_points[0];
    const double there =
        distance(particle.dense.radius(contact_point.on_particle) *
                 contact_point.on_particle);
    EXPECT_GE(contact_point.overlap, -gap - 1e-4 * particle.mean) << pose;
    EXPECT_NEAR(contact_point.overlap, -there, 1e-4 * particle.mean) << pose;
  }
}

/// Smallest distance of points of one particle from the other one along rays
/// from its centre: below zero where the two overlap.
double along_rays(const Particle &of, const Particle &from,
                  const dem::RelativePose &pose)
{
  const dem::Mat3 back = pose.rotation.transpose();
  static const int n_rings = 40;
  const DensePoints dense(of.body, n_rings);
  return dense.least(
      [&](const Vec3 &x)
      {
        const Vec3 seen = back * (x - pose.position);
        const double distance = seen.norm();
        return distance == 0. ? -from.mean
                              : distance - from.dense.radius(seen / distance);
      });
}

dem::RelativePose inverted(const dem::RelativePose &pose)
{
  const dem::Mat3 back = pose.rotation.transpose();
  return {-(back * pose.position), back};
}

void expect_pairs(const Particle &a, const Particle &b, int n_poses)
{
  dem::Random random(21);
  const auto is_apart = [&](const dem::RelativePose &pose)
  {
    return along_rays(a, b, pose) > 0. && along_rays(b, a, inverted(pose)) > 0.;
  };
  for (int k = 0; k < n_poses; ++k)
  {
    const Vec3 along = random.rotation() * Vec3::UnitX();
    dem::RelativePose pose{Vec3::Zero(), random.rotation().toRotationMatrix()};
    double far = a.body.circumscribed_radius + b.body.circumscribed_radius;
    double near = far;
    const double step = 0.04 * far;
    do
    {
      far = near;
      near -= step;
      pose.position = near * along;
    } while (near > 0. && is_apart(pose));
    for (int halving = 0; halving < 16; ++halving)
    {
      const double middle = 0.5 * (far + near);
      pose.position = middle * along;
      (is_apart(pose) ? far : near) = middle;
    }
    pose.position = far * along;
    const double size = std::min(a.mean, b.mean);
    const dem::MappedPair pair{a.mapped(), b.mapped(), pose};
    const dem::Separation slab = dem::separate(pair, along, 0.02 * size);
    EXPECT_LE(slab.gap, 1e-4 * size) << k;
    const dem::ContactPointSearch found =
        dem::find_contact_points(pair, slab, 0.02 * size);
    ASSERT_FALSE(found.contact_points.empty()) << k;
    EXPECT_NEAR(found.contact_points[0].overlap / size, 0., 1e-3) << k;
  }
}

dem::EngineParameters surface_parameters(double mean)
{
  dem::EngineParameters p = support::bare_parameters();
  p.geometry.geometry = p.geometry.wall_geometry =
      dem::ContactGeometry::surface;
  p.wall.normal_stiffness = 1e6;
  p.surface = p.wall;
  p.geometry.usual_skin = 0.2 * mean;
  return p;
}

/// The way of the first particle until it meets something [m].
double way_to_force(dem::Engine &engine, const Vec3 &velocity, double step)
{
  engine.particles().velocity(0) = velocity;
  const Vec3 start = engine.particles().position(0);
  for (int k = 0; k < 4000; ++k)
  {
    engine.advance(step);
    if (!engine.particles().load[0].force.isZero(0.))
      break;
  }
  return (engine.particles().position(0) - start).norm();
}

// A particle moves on to a plane, to facets and to a ball: the first force
// comes in the step of the first touch.
void expect_first_force(const Particle &particle)
{
  const double room = 0.25 * particle.mean, speed = 1.,
               step = 2e-3 * particle.mean / speed;
  for (const Vec3 &n : directions_for(particle))
  {
    const dem::Quaternion turned =
        dem::Quaternion::FromTwoVectors(n, -Vec3::UnitZ());
    const Vec3 down = turned.conjugate() * -Vec3::UnitZ();
    const Vec3 centre(0., 0., particle.height(down) + room);
    const auto expect_way = [&](dem::Engine &engine, const char *on)
    {
      const double way = way_to_force(engine, -speed * Vec3::UnitZ(), step);
      EXPECT_GE(way, room - 1e-4 * particle.mean) << on << n.transpose();
      EXPECT_LE(way, room + 1.5 * speed * step) << on << n.transpose();
    };
    dem::Engine on_plane(surface_parameters(particle.mean));
    dem::add_plane(on_plane, Vec3::Zero(), Vec3::UnitZ());
    on_plane.add_particle(particle.body, centre, turned);
    expect_way(on_plane, "plane ");
    dem::Engine on_facets(surface_parameters(particle.mean));
    dem::attach_surface(on_facets,
                        support::flat_floor(2. * particle.mean, 16, 0.));
    on_facets.add_particle(particle.body, centre, turned);
    expect_way(on_facets, "facets ");
    dem::Engine in_drum(surface_parameters(particle.mean));
    dem::Drum drum;
    drum.axis = Vec3::UnitZ();
    drum.radius = 1.;
    drum.length = 2.;
    drum.centre = Vec3::UnitZ();
    dem::set_drum(in_drum, drum);
    in_drum.add_particle(particle.body, centre, turned);
    expect_way(in_drum, "drum ");
  }
}

// Between two platens at the tips the load is on both from the start: each side
// of a spring of stiffness k gives way by half of the way.
void expect_platens(const Particle &particle)
{
  constexpr double stiffness = 1e6; // N/m
  const double speed = 2e-3, step = 1e-5, way = 5e-3 * particle.mean;
  Vec3 tip;
  particle.dense.least([](const Vec3 &x) { return -x.norm(); }, &tip);
  const dem::Quaternion turned =
      dem::Quaternion::FromTwoVectors(tip, Vec3::UnitZ());
  dem::EngineParameters p = surface_parameters(particle.mean);
  p.wall.normal_stiffness = stiffness;
  p.local_damping = 0.7;
  dem::Engine engine(p);
  engine.add_particle(particle.body, Vec3::Zero(), turned);
  dem::add_plane(engine, -particle.height(-tip) * Vec3::UnitZ(), Vec3::UnitZ());
  dem::add_plane(engine, particle.height(tip) * Vec3::UnitZ(), -Vec3::UnitZ());
  dem::planes(engine)[1].velocity = -speed * Vec3::UnitZ();
  while (engine.time() < way / speed)
    engine.advance(step);
  const double expected = 0.5 * stiffness * speed * engine.time();
  EXPECT_NEAR(-dem::planes(engine)[0].force.z(), expected, 0.05 * expected);
  EXPECT_NEAR(dem::planes(engine)[1].force.z(), expected, 0.05 * expected);
  EXPECT_EQ(engine.contact_point_events().n_late, 0);
}

void expect_all(const Form &form)
{
  const Particle particle(form);
  if (!(particle.body.least_radius > 0.))
    return; // refused where shapes are read
  expect_bounds(particle);
  expect_supports(particle);
  expect_drum(particle);
  expect_facets(particle);
  expect_first_force(particle);
  expect_platens(particle);
  const Particle other({2., 12, true, 1});
  expect_pairs(particle, particle, 2);
  expect_pairs(particle, other, 2);
}

class FirstTouch : public testing::TestWithParam<Form>
{
};
class LongFirstTouch : public testing::TestWithParam<Form>
{
};

std::vector<Form> all_forms()
{
  std::vector<Form> all;
  for (const double ratio : {2., 4., 6., 10., 20.})
    for (const int order : {8, 12, 20, 30})
      for (const bool is_plate : {false, true})
        for (const int turn : {0, 1, 2})
          all.push_back({ratio, order, is_plate, turn});
  return all;
}
} // namespace

TEST_P(FirstTouch, IsWhereGeometrySays)
{
  expect_all(GetParam());
}
TEST_P(LongFirstTouch, IsWhereGeometrySays)
{
  expect_all(GetParam());
}

INSTANTIATE_TEST_SUITE_P(
    Forms, FirstTouch,
    testing::Values(Form{2., 20, false, 1}, Form{6., 30, false, 0},
                    Form{6., 20, false, 2}, Form{10., 12, true, 1},
                    Form{20., 30, false, 1}, Form{20., 30, true, 0}));
INSTANTIATE_TEST_SUITE_P(All, LongFirstTouch, testing::ValuesIn(all_forms()));
