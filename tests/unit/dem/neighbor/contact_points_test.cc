#include <dem/neighbor/contact_points.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <shape/test_shapes.h>

// Where two true surfaces meet: against closed forms and against a brute force
// that knows nothing but the radius of the series.
namespace
{
using dem::ParticleShape;
using dem::Vec3;

struct Particle
{
  ParticleShape body;
  dem::RadiusMap map;

  explicit Particle(std::vector<double> a)
      : body(dem::shape_of(std::move(a))), map(body.series)
  {
  }
  explicit Particle(double radius)
      : body(dem::make_sphere(radius)), map(nullptr)
  {
  }
};

dem::MappedPair seen(const Particle &a, const Particle &b,
                     const dem::RelativePose &pose)
{
  return {{a.body, a.map}, {b.body, b.map}, pose};
}

dem::ContactPointSearch search(const Particle &a, const Particle &b,
                               const dem::RelativePose &pose, double margin)
{
  const dem::MappedPair pair = seen(a, b, pose);
  return dem::find_contact_points(
      pair, dem::separate(pair, pose.position.normalized()), margin);
}

/// A rounded box of exponent 6, as angular as the series can carry.
std::vector<double> box_series(int order, const Vec3 &half)
{
  return dem::test::project(order,
                            [&](const Vec3 &s)
                            {
                              double sum = 0.;
                              for (int d = 0; d < 3; ++d)
                                sum += std::pow(std::abs(s[d]) / half[d], 6);
                              return std::pow(sum, -1. / 6.);
                            });
}

class Turns
{
public:
  explicit Turns(unsigned seed) : generator(seed) {}
  Vec3 direction()
  {
    return Vec3(normal(generator), normal(generator), normal(generator))
        .normalized();
  }
  dem::Mat3 rotation()
  {
    return dem::Quaternion(normal(generator), normal(generator),
                           normal(generator), normal(generator))
        .normalized()
        .toRotationMatrix();
  }

private:
  std::mt19937 generator;
  std::normal_distribution<double> normal;
};

Vec3 on_surface(const ParticleShape &body, const Vec3 &s)
{
  return body.scale * (body.series ? dem::radius(*body.series, s) : 1.) * s;
}

/// Distance between two separate surfaces from one pair of directions on:
/// compass search over both.
double compass(const ParticleShape &a, const ParticleShape &b,
               const dem::RelativePose &pose, std::array<Vec3, 2> at)
{
  const auto distance = [&](const std::array<Vec3, 2> &s)
  {
    return (on_surface(a, s[0]) - pose.position -
            pose.rotation * on_surface(b, s[1]))
        .norm();
  };
  double best = distance(at);
  for (double step = 0.05; step > 1e-8;)
  {
    bool is_better = false;
    for (std::size_t side = 0; side < 2; ++side)
    {
      const dem::test::Tangents frame = dem::test::tangents(at[side]);
      for (const Vec3 &move :
           {frame.first, Vec3(-frame.first), frame.second, Vec3(-frame.second)})
      {
        std::array<Vec3, 2> next = at;
        next[side] = (at[side] + step * move).normalized();
        if (const double there = distance(next); there < best)
        {
          best = there;
          at = next;
          is_better = true;
        }
      }
    }
    if (!is_better)
      step *= 0.5;
  }
  return best;
}

/// Smallest distance of all points of a dense grid, the best few followed.
double brute_force(const ParticleShape &a, const ParticleShape &b,
                   const dem::RelativePose &pose)
{
  constexpr dem::DirectionGrid grid{24, 48};
  std::array<std::vector<Vec3>, 2> points;
  for (int node = 0; node < grid.size(); ++node)
  {
    const Vec3 s = grid.direction(node / 48, node % 48);
    points[0].push_back(on_surface(a, s));
    points[1].push_back(pose.position + pose.rotation * on_surface(b, s));
  }
  struct Start
  {
    double distance;
    std::array<Vec3, 2> at;
  };
  std::vector<Start> starts;
  for (int i = 0; i < grid.size(); ++i)
  {
    const Vec3 &x = points[0][static_cast<std::size_t>(i)];
    Start nearest{1e9, {}};
    for (int j = 0; j < grid.size(); ++j)
      if (const double d =
              (points[1][static_cast<std::size_t>(j)] - x).squaredNorm();
          d < nearest.distance)
        nearest = {d, {x.normalized(), grid.direction(j / 48, j % 48)}};
    starts.push_back(nearest);
  }
  std::sort(starts.begin(), starts.end(),
            [](const Start &p, const Start &q)
            { return p.distance < q.distance; });
  double best = 1e9;
  for (std::size_t k = 0; k < 8; ++k)
    best = std::min(best, compass(a, b, pose, starts[k].at));
  return best;
}

/// B comes nearer along a line until the particles are `gap` apart or nearly
/// so.
dem::RelativePose approach(const Particle &a, const Particle &b, Turns &turns,
                           double gap)
{
  const Vec3 along = turns.direction();
  dem::RelativePose pose{Vec3::Zero(), turns.rotation()};
  double distance = a.body.circumscribed_radius + b.body.circumscribed_radius;
  for (int step = 0; step < 200; ++step)
  {
    pose.position = distance * along;
    const dem::ContactPointSearch found =
        search(a, b, pose, 0.3 * a.body.scale);
    const double free = found.contact_points.empty()
                            ? 1e-3
                            : -found.contact_points.front().overlap;
    if (free < 1.5 * gap)
      break;
    distance -= 0.3 * (free - gap);
  }
  return pose;
}
} // namespace

TEST(ContactPoints, SpheresMeetOnTheBranch)
{
  const Particle a(0.01), b(0.004);
  const Vec3 u = Vec3(1., 2., -3.).normalized();
  for (const double gap : {-3e-4, 2e-4})
  {
    const dem::ContactPointSearch found =
        search(a, b, {(0.014 + gap) * u, dem::Mat3::Identity()}, 1e-3);
    ASSERT_EQ(found.contact_points.size(), 1u);
    EXPECT_NEAR(found.contact_points[0].overlap, -gap, 1e-15);
    EXPECT_LT((found.contact_points[0].on_a - u).norm(), 1e-9);
  }
}

// The pole of an ellipsoid over a ball, its curvature b / a^2 there known.
TEST(ContactPoints, EllipsoidHasItsCurvaturesAndSupports)
{
  const Vec3 axes(0.012, 0.010, 0.008);
  const Particle particle(dem::test::project(
      20, [&](const Vec3 &s) { return dem::test::ellipsoid_radius(axes, s); }));
  const dem::SurfacePoint pole =
      dem::surface_point(particle.body, Vec3::UnitZ());
  // Truncation at order 20 leaves 1e-7 of r and 1e-4 of the curvature.
  EXPECT_NEAR(pole.shape_operator(0, 0), 0.008 / (0.012 * 0.012), 0.05);
  EXPECT_NEAR(pole.shape_operator(1, 1), 0.008 / (0.010 * 0.010), 0.05);
  for (const Vec3 &n : dem::test::random_directions(20, 3))
  {
    const double height = axes.cwiseProduct(n).norm(); // of an ellipsoid
    const auto found = dem::find_supports({particle.body, particle.map}, n,
                                          {height - 1e-3, height});
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NEAR(found[0].overlap, 0., 1e-7);
    EXPECT_GE(particle.map.height(n).height, height - 1e-7);
  }
}

// 60 pairs of rough, boxy and long particles, size ratio up to 3, a little
// apart.
TEST(ContactPoints, GapAgreesWithBruteForce)
{
  const Particle rough(dem::test::random_particle(16, 4)),
      boxy(box_series(20, Vec3(0.010, 0.008, 0.007))),
      small(box_series(12, Vec3(0.003, 0.004, 0.003)));
  const std::array<std::array<const Particle *, 2>, 3> kinds = {
      {{&rough, &boxy}, {&boxy, &boxy}, {&rough, &small}}};
  Turns turns(11);
  int n_pairs = 0;
  for (const auto &[a, b] : kinds)
    for (int pair = 0; pair < 20; ++pair)
    {
      const dem::RelativePose pose = approach(*a, *b, turns, 1e-4);
      const dem::ContactPointSearch found = search(*a, *b, pose, 1e-3);
      ASSERT_FALSE(found.contact_points.empty());
      const double gap = -found.contact_points.front().overlap;
      if (gap < 1e-6)
        continue;
      ++n_pairs;
      const double diameter = 2. * dem::mean_radius(a->body);
      EXPECT_NEAR(gap, brute_force(a->body, b->body, pose), 1e-6 * diameter);
      const dem::MappedPair both = seen(*a, *b, pose);
      EXPECT_LE(dem::separate(both, pose.position.normalized()).gap, gap);
    }
  EXPECT_GT(n_pairs, 50);
}

// An overlap along the common normal is what it takes to part the particles
// there.
TEST(ContactPoints, OverlapIsTheShiftThatPartsThem)
{
  const Particle rough(dem::test::random_particle(16, 4)),
      boxy(box_series(20, Vec3(0.010, 0.008, 0.007)));
  Turns turns(5);
  for (int pair = 0; pair < 20; ++pair)
  {
    dem::RelativePose pose = approach(rough, boxy, turns, 1e-4);
    pose.position *= 0.985;
    const dem::ContactPointSearch found = search(rough, boxy, pose, 1e-4);
    ASSERT_FALSE(found.contact_points.empty());
    const dem::ContactPoint &contact_point = found.contact_points.front();
    const Vec3 normal =
        dem::surface_point(rough.body, contact_point.on_a).normal;
    const double apart = 2e-5;
    dem::RelativePose parted = pose;
    parted.position += (contact_point.overlap + apart) * normal;
    EXPECT_NEAR(compass(rough.body, boxy.body, parted,
                        {contact_point.on_a, contact_point.on_b}),
                apart, 1e-8);
  }
}

TEST(ContactPoints, KnownContactPointsAreLeftOut)
{
  const Particle a(dem::test::random_particle(12, 1)),
      b(dem::test::random_particle(12, 2));
  Turns turns(2);
  const dem::RelativePose pose = approach(a, b, turns, 1e-5);
  const dem::MappedPair pair = seen(a, b, pose);
  const dem::Separation between =
      dem::separate(pair, pose.position.normalized());
  const dem::ContactPointSearch all =
      dem::find_contact_points(pair, between, 5e-4);
  ASSERT_FALSE(all.contact_points.empty());
  EXPECT_TRUE(dem::find_contact_points(pair, between, 5e-4, all.contact_points)
                  .contact_points.empty());
}
