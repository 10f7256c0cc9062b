#include "specimen/last_state.h"
#include "specimen/placed_particles.h"
#include "test_folder.h"

#include <dem/engine_boundaries.h>
#include <dem/parallel/ranks.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>

namespace
{
using namespace spall;
namespace fs = std::filesystem;

/// Three particles of two shapes that touch each other and a floor; one of
/// them has broken.
class LastState : public testing::Test
{
protected:
  void SetUp() override
  {
    folder = support::test_folder();
    c.file = (folder / "case.prm").string();
    settings.particle.friction = 0.;
    settings.wall.friction = 0.;
    settings.other_solids = {{}};
    settings.geometry.usual_skin = 1e-3;
    library = load_shapes(c, "Scene", SPALL_SHAPES_DIR "/limestone_blocky");
    dem::Coefficients series = *library[1];
    for (std::size_t j = 4; j < series.size(); j += 7)
      series[j] *= 0.97;
    const dem::ParticleShape broken = dem::shape_of(
        std::move(series), dem::sphere_rule(c.breakage.quadrature_rings));
    const double step = 1.9 * dem::mean_radius(broken);
    const dem::ParticleShape whole =
        dem::make_shape(library[0], dem::mean_radius(broken));
    const dem::Quaternion turned(
        Eigen::AngleAxisd(0.7, dem::Vec3(1., 2., -1.).normalized()));
    engine = std::make_unique<dem::Engine>(settings, dem::one_rank());
    engine->add_particle(whole, {0., 0., 0.}, turned);
    engine->add_particle(broken, {step, 0., 0.}, turned.conjugate());
    engine->add_particle(dem::make_sphere(dem::mean_radius(broken)),
                         {2. * step, 1e-4, 0.}, turned, 1);
    engine->particles().velocity(1) = {0.1, 1. / 3., 0.};
    engine->particles().spin(2) = {0., 0., 2. / 7.};
    dem::add_plane(*engine, {0., 0., -0.48 * step}, dem::Vec3::UnitZ());
    engine->set_breaking(false);
  }

  PlacedParticles read() const
  {
    return place_particles(
        c, {"Scene", folder.string(), "", dem::max_order, "section Other"});
  }

  fs::path folder;
  Case c;
  dem::EngineParameters settings;
  ShapeLibrary library;
  std::unique_ptr<dem::Engine> engine;
};

// What has no history has the same forces: only the volumes and bounds of the
// shapes are computed again.
TEST_F(LastState, IsTheStartOfAnotherRun)
{
  engine->evaluate(1e-9);
  write_last_state(folder, engine->particles(), library);
  const PlacedParticles read_back = read();
  dem::Engine next(settings, dem::one_rank());
  add_particles(read_back, next);
  dem::add_plane(next, dem::planes(*engine)[0].point, dem::Vec3::UnitZ());
  next.set_breaking(false);
  next.evaluate(1e-9);
  const dem::ParticleSystem &was = engine->particles(), &is = next.particles();
  ASSERT_EQ(is.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i)
  {
    EXPECT_EQ(is.position(i), was.position(i));
    EXPECT_EQ(is.velocity(i), was.velocity(i));
    EXPECT_EQ(is.spin(i), was.spin(i));
    EXPECT_EQ(is.orientation(i).coeffs(), was.orientation(i).coeffs());
    EXPECT_EQ(is.material[i], was.material[i]);
    EXPECT_NEAR(is.shape[i].volume, was.shape[i].volume,
                1e-14 * was.shape[i].volume);
    EXPECT_NEAR(is.mass(i), was.mass(i), 1e-14 * was.mass(i));
    const double size = was.load[i].force.norm();
    EXPECT_GT(size, 0.);
    EXPECT_LT((is.load[i].force - was.load[i].force).norm(), 1e-10 * size);
  }
  EXPECT_EQ(next.pairs().size(), engine->pairs().size());
}

TEST_F(LastState, WritesEachShapeOnceAndThoseThatHaveBroken)
{
  engine->add_particle(engine->particles().shape[0], {0., 1., 0.},
                       dem::Quaternion::Identity());
  write_last_state(folder, engine->particles(), library);
  EXPECT_TRUE(fs::exists(folder / "shapes" / "particle_1.json"));
  EXPECT_TRUE(
      fs::exists(folder / "shapes" / (library.entry(0).name + ".json")));
  const auto n = std::distance(fs::directory_iterator(folder / "shapes"), {});
  EXPECT_EQ(n, 2);
  EXPECT_EQ(read().shapes.entry(1).licence, library.entry(1).licence);
}

// A chain of runs: particle 1 has broken before, and again.
TEST_F(LastState, NamesOfShapesStayApart)
{
  write_last_state(folder, engine->particles(), library);
  const PlacedParticles second = read();
  dem::ParticleSystem all = engine->particles();
  dem::Coefficients series = *second.shapes[1];
  series[9] *= 0.9;
  all.shape[0] = second.body[1];
  all.shape[1] = dem::shape_of(std::move(series));
  write_last_state(folder, all, second.shapes);
  EXPECT_TRUE(fs::exists(folder / "shapes" / "particle_1.json"));
  EXPECT_TRUE(fs::exists(folder / "shapes" / "particle_1_.json"));
  const PlacedParticles third = read();
  EXPECT_EQ(*third.body[0].series, *second.body[1].series);
}

TEST_F(LastState, IsGoneWithoutParticles)
{
  write_last_state(folder, engine->particles(), library);
  write_last_state(folder, {}, library);
  EXPECT_FALSE(fs::exists(folder / "particles.csv"));
  EXPECT_FALSE(fs::exists(folder / "shapes"));
}
} // namespace
