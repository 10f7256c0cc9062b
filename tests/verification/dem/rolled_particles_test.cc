#include "dem_scene.h"

#include <dem/neighbor/contact_points.h>

#include <gtest/gtest.h>

#include <shape/file.h>
#include <shape/test_shapes.h>

// Two particles pressed together and rolled over each other for 1e5 steps: at
// every look the contacts are where a search that knows nothing of them finds
// two particles to meet, and between two steps none is elsewhere unnoticed.
namespace
{
using dem::Vec3;

constexpr double equivalent_radius = 0.01; // [m]
constexpr double diameter = 2. * equivalent_radius;
constexpr double time_step = 2e-6; // [s]

/// Two directions farther apart are of two contact points [-].
constexpr double elsewhere = 0.05;

/// Where two particles overlap, each contact point in their body frames: those
/// that bear, or also those that were found late and wait until they have
/// opened.
std::vector<dem::ContactPoint> contact_points(const dem::ContactBatch &pairs,
                                              bool with_waiting)
{
  std::vector<dem::ContactPoint> found;
  for (std::size_t k = 0; k < pairs.size(); ++k)
    if (pairs.is_touching(k) || (with_waiting && pairs.overlap_offset[k] > 0. &&
                                 pairs.side_a.is_known(k)))
      found.push_back({pairs.side_a.contact_point(k),
                       pairs.side_b.contact_point(k),
                       pairs.overlap[k] + pairs.overlap_offset[k], true});
  return found;
}

/// How far apart two contact points are, on the particle where it is more [-].
double apart(const dem::ContactPoint &p, const dem::ContactPoint &q)
{
  return std::max((p.on_a - q.on_a).norm(), (p.on_b - q.on_b).norm());
}

/// The nearest of some contact points, if any is nearer than another contact
/// point would be.
const dem::ContactPoint *beside(const dem::ContactPoint &contact_point,
                                const std::vector<dem::ContactPoint> &others)
{
  const dem::ContactPoint *nearest = nullptr;
  for (const dem::ContactPoint &other : others)
    if (apart(contact_point, other) <
        (nearest ? apart(contact_point, *nearest) : elsewhere))
      nearest = &other;
  return nearest;
}

/// What a run has shown.
struct Findings
{
  int n_looks = 0;
  int n_several = 0;   ///< looks at more than one contact point
  int n_missed = 0;    ///< contact points that only the search has
  int n_alone = 0;     ///< contact points that only the engine has
  int n_invented = 0;  ///< of them: no common normal is there
  int n_unnoticed = 0; ///< moves to another contact point that were not counted
  double worst = 0.;   ///< error of an overlap [m]
  dem::ContactPointEvents events;
};

/// Particles held together by a force between their centres and driven about
/// two axes.
class Rolled
{
public:
  Rolled(const dem::ParticleShape &a, const dem::ParticleShape &b)
      : map_a(a.series), map_b(b.series), engine(parameters())
  {
    engine.add_particle(a, Vec3::Zero(), dem::Quaternion::Identity());
    engine.add_particle(
        b, {0., 0., a.circumscribed_radius + b.circumscribed_radius},
        dem::Quaternion::Identity());
  }

  Findings roll(int n_steps)
  {
    Findings found;
    std::vector<dem::ContactPoint> before;
    for (int step = 0; step < n_steps; ++step)
    {
      const std::int64_t n_noticed = noticed();
      advance();
      const std::vector<dem::ContactPoint> now =
          contact_points(engine.pairs(), false);
      std::int64_t n_moved = 0;
      for (const dem::ContactPoint &contact_point : now)
        n_moved += contact_point.overlap > overlap_of_a_step() &&
                   !beside(contact_point, before);
      found.n_unnoticed += static_cast<int>(
          std::max<std::int64_t>(0, n_moved - (noticed() - n_noticed)));
      if (step % 100 == 0)
        look(found);
      before = contact_points(engine.pairs(), true);
    }
    found.events = engine.contact_point_events();
    return found;
  }

private:
  static dem::EngineParameters parameters()
  {
    dem::EngineParameters p = support::bare_parameters();
    p.geometry.geometry = p.geometry.wall_geometry =
        dem::ContactGeometry::surface;
    p.geometry.usual_skin = 3e-4;
    p.particle.friction = 0.6;
    p.particle.normal_damping = p.particle.shear_damping = 0.3;
    // The error of the expansions goes with its third power: at the default of
    // 5e-3 it is 6e-6 of the diameter here.
    p.geometry.refresh_tolerance = 1e-3;
    return p;
  }

  void advance()
  {
    constexpr double force = 20.; // [N]
    dem::ParticleSystem &particles = engine.particles();
    const Vec3 pull =
        force * time_step *
        (particles.position(1) - particles.position(0)).normalized();
    particles.velocity(0) += pull / particles.mass(0);
    particles.velocity(1) -= pull / particles.mass(1);
    particles.spin(0) = {8., 3., 0.};
    particles.spin(1) = {-8., 2., 0.};
    engine.advance(time_step);
  }

  std::int64_t noticed() const
  {
    return engine.contact_point_events().n_jumps +
           engine.contact_point_events().n_late;
  }

  /// What one step makes of a new contact at most [m].
  double overlap_of_a_step() const
  {
    const dem::ParticleSystem &particles = engine.particles();
    return 1.1 * time_step *
           ((particles.velocity(0) - particles.velocity(1)).norm() +
            particles.spin(0).norm() * particles.shape[0].circumscribed_radius +
            particles.spin(1).norm() * particles.shape[1].circumscribed_radius);
  }

  /// What a search from nothing says of this moment.
  void look(Findings &found) const
  {
    const std::vector<dem::ContactPoint> now = contact_points(engine.pairs(),
                                                              false),
                                         known = contact_points(engine.pairs(),
                                                                true);
    const dem::ParticleSystem &particles = engine.particles();
    const dem::Mat3 to_a = particles.rotation(0).transpose();
    const dem::MappedPair pair{
        {particles.shape[0], map_a},
        {particles.shape[1], map_b},
        {to_a * (particles.position(1) - particles.position(0)),
         to_a * particles.rotation(1)}};
    const std::vector<dem::ContactPoint> exact =
        dem::find_contact_points(
            pair, dem::separate(pair, pair.pose.position.normalized()),
            0.01 * diameter)
            .contact_points;
    ++found.n_looks;
    found.n_several += now.size() > 1;
    for (const dem::ContactPoint &contact_point : now)
    {
      const dem::ContactPoint *same = beside(contact_point, exact);
      found.n_alone += !same;
      const dem::ContactPoint here =
          same ? *same
               : dem::refine(particles.shape[0], particles.shape[1], pair.pose,
                             contact_point);
      found.n_invented +=
          !here.is_found || apart(here, contact_point) > elsewhere;
      found.worst =
          std::max(found.worst, std::abs(here.overlap - contact_point.overlap));
    }
    for (const dem::ContactPoint &contact_point : exact)
      found.n_missed += contact_point.overlap > 1e-5 * diameter &&
                        !beside(contact_point, known);
  }

  dem::RadiusMap map_a, map_b;
  dem::Engine engine;
};

dem::ParticleShape scanned(const std::string &name)
{
  return dem::make_shape(
      std::make_shared<const dem::Coefficients>(
          spall::read_shape(SPALL_SHAPES "/" + name).coefficients),
      equivalent_radius);
}

dem::ParticleShape generated(unsigned seed)
{
  return dem::make_shape(std::make_shared<const dem::Coefficients>(
                             dem::test::random_particle(14, seed)),
                         equivalent_radius);
}

/// A lens in the middle of which the surfaces become concave parts in two: the
/// new contact point is missed until the pair is searched again, and is counted
/// as late then. The search from nothing has its own blind regions: contact
/// points beside a deeper one that no node of the maps is nearest to.
void expect_tracked(const char *name, const dem::ParticleShape &a,
                    const dem::ParticleShape &b)
{
  const Findings found = Rolled(a, b).roll(100000);
  std::printf(
      "%s: %d looks, %d at several contact points, overlap wrong by %.2g of "
      "the diameter at most; %d contact points missed, %d that only the engine "
      "has, %d of them invented; jumps: %d counted, %d not; %d ended, "
      "%d found late\n",
      name, found.n_looks, found.n_several, found.worst / diameter,
      found.n_missed, found.n_alone, found.n_invented,
      static_cast<int>(found.events.n_jumps), found.n_unnoticed,
      static_cast<int>(found.events.n_ended),
      static_cast<int>(found.events.n_late));
  EXPECT_EQ(found.n_looks, 1000);
  EXPECT_LT(found.worst, 1e-6 * diameter);
  EXPECT_LE(found.n_missed, 10);
  EXPECT_LE(found.n_alone, 10);
  // A lens that goes flat is held for some twenty steps: one look in five.
  EXPECT_LE(found.n_invented, found.events.n_ended);
  EXPECT_EQ(found.n_unnoticed, 0);
}
} // namespace

TEST(RolledParticles, ContactsOfGeneratedParticlesAreTracked)
{
  expect_tracked("generated", generated(3), generated(8));
}

TEST(RolledParticles, ContactsOfScannedParticlesAreTracked)
{
  expect_tracked("blocky limestone",
                 scanned("limestone_blocky/MA111-7-coarse-00104.json"),
                 scanned("limestone_blocky/MA111-7-coarse-00132.json"));
  expect_tracked("flaky limestone",
                 scanned("limestone/MA111-7-coarse-00017.json"),
                 scanned("limestone/MA111-7-coarse-00164.json"));
}
