#include <dem/instruction_set.h>

#include <gtest/gtest.h>

#include <cstring>
#include <neighbor/node_list.h>
#include <neighbor/node_minima.h>
#include <shape/test_shapes.h>

// What the search for contact points reads off the map of a particle: against
// the series, and with the same digits for every instruction set.
namespace
{
using dem::Vec3;

struct Particle
{
  dem::ParticleShape body = dem::shape_of(dem::test::random_particle(12, 5));
  dem::RadiusMap map{body.series};

  dem::MappedParticle mapped() const { return {body, map}; }
};

dem::RelativePose turned_pose()
{
  return {Vec3(3e-3, -2e-3, 1e-3),
          Eigen::AngleAxisd(1.1, Vec3(1., 2., -1.).normalized()).matrix()};
}

struct Points
{
  std::vector<float> x, y, z, gap;

  explicit Points(const std::vector<Vec3> &at)
  {
    const std::size_t room = at.size() + dem::kernel::map_spare;
    for (std::vector<float> *column : {&x, &y, &z, &gap})
      column->resize(room);
    for (std::size_t k = 0; k < at.size(); ++k)
    {
      x[k] = static_cast<float>(at[k].x());
      y[k] = static_cast<float>(at[k].y());
      z[k] = static_cast<float>(at[k].z());
    }
  }
  dem::kernel::PointRows rows() { return {x.data(), y.data(), z.data()}; }
};

/// Around the particle, from deep inside to beyond, poles of its frame among
/// them.
std::vector<Vec3> points_around(const dem::RelativePose &pose)
{
  std::vector<Vec3> at;
  for (Vec3 s : dem::test::random_directions(501, 3))
    at.push_back(pose.position +
                 (0.007 + 1e-5 * static_cast<double>(at.size())) * s);
  for (const double sign : {-1., 1.})
    at.push_back(pose.position + pose.rotation * Vec3(0., 0., sign * 0.011));
  return at;
}

std::vector<float> gaps_of(const std::vector<Vec3> &at,
                           const dem::RelativePose &pose)
{
  const Particle particle;
  Points points(at);
  dem::find_gaps(particle.mapped(), pose, 2e-3, points.rows(),
                 static_cast<int>(at.size()), points.gap.data());
  points.gap.resize(at.size());
  return points.gap;
}
} // namespace

TEST(NodeList, HoldsTheNodesThatAreHighEnough)
{
  const Particle particle;
  const Vec3 up = Vec3(0.3, -0.8, 0.5).normalized();
  const double lowest = 7e-3;
  const dem::NodeList list(particle.mapped(), up, lowest);
  int n = 0;
  for (int node = 0; node < dem::RadiusMap::nodes.size(); ++node)
  {
    const Vec3 point =
        particle.body.scale * particle.map.point(node).cast<double>();
    // Nodes at the limit may go either way.
    if (point.dot(up) < lowest + 1e-9)
      continue;
    while (n < list.size() && list.node(n) < node)
      ++n;
    ASSERT_LT(n, list.size());
    ASSERT_EQ(list.node(n), node);
    EXPECT_LT((list.position(n) - point).norm(), 1e-8);
  }
  EXPECT_GT(n, 100);
}

TEST(NodeList, GapsAreThoseOfTheSeriesAlongTheRay)
{
  const Particle particle;
  const dem::RelativePose pose = turned_pose();
  const std::vector<Vec3> at = points_around(pose);
  const std::vector<float> gap = gaps_of(at, pose);
  for (std::size_t k = 0; k < at.size(); ++k)
  {
    const Vec3 branch = pose.rotation.transpose() * (at[k] - pose.position);
    const dem::SurfacePoint below =
        dem::surface_point(particle.body, branch.normalized());
    const double cosine = below.normal.dot(branch.normalized());
    const double ray = branch.norm() - below.position.norm();
    // Bilinear between nodes 0.065 rad apart; 1 % of the radius would show.
    EXPECT_NEAR(gap[k], cosine * ray, 3e-5) << k;
  }
}

TEST(NodeList, FarPointsAreInfinitelyFar)
{
  const dem::RelativePose pose = turned_pose();
  EXPECT_EQ(gaps_of({pose.position + Vec3(0.02, 0., 0.)}, pose)[0],
            std::numeric_limits<float>::infinity());
}

TEST(NodeList, HasOneSetOfDigitsForAllInstructionSets)
{
  const Particle particle;
  const dem::RelativePose pose = turned_pose();
  const std::vector<Vec3> at = points_around(pose);
  const dem::InstructionSet widest = dem::widest_instruction_set();
  dem::use_instruction_set(dem::InstructionSet::baseline);
  const std::vector<float> gap = gaps_of(at, pose);
  const dem::NodeList list(particle.mapped(), Vec3::UnitX(), 6e-3);
  for (const dem::InstructionSet set :
       {dem::InstructionSet::avx2, dem::InstructionSet::avx512})
  {
    if (set > widest)
      continue;
    dem::use_instruction_set(set);
    const std::vector<float> same = gaps_of(at, pose);
    EXPECT_EQ(std::memcmp(same.data(), gap.data(), sizeof(float) * at.size()),
              0)
        << name_of(set);
    const dem::NodeList again(particle.mapped(), Vec3::UnitX(), 6e-3);
    ASSERT_EQ(again.size(), list.size()) << name_of(set);
    for (int k = 0; k < list.size(); ++k)
    {
      EXPECT_EQ(again.node(k), list.node(k)) << name_of(set);
      EXPECT_EQ(again.position(k), list.position(k)) << name_of(set);
    }
  }
  dem::use_instruction_set(widest);
}

TEST(NodeGaps, FindsTheLeastOfNeighboursRoundAndBeyondThePoles)
{
  constexpr dem::DirectionGrid nodes = dem::RadiusMap::nodes;
  for (const int node :
       {0, 47, 95, 96 * 20, 96 * 20 + 95, 96 * 47, 96 * 48 - 1})
    for (int down = -1; down <= 1; ++down)
      for (int right = -1; right <= 1; ++right)
      {
        const int beside = nodes.neighbour(node / nodes.n_azimuth,
                                           node % nodes.n_azimuth, down, right);
        dem::NodeGaps gaps;
        gaps.set(node, 1.f);
        gaps.set(beside, beside == node ? 1.f : 0.5f);
        gaps.close();
        EXPECT_EQ(gaps.is_least(node), beside == node) << node;
        EXPECT_TRUE(gaps.is_least(beside)) << node;
      }
}
