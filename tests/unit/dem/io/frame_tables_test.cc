#include "dem_scene.h"

#include <dem/io/frame_tables.h>

#include <gtest/gtest.h>

#include <map>

// What stands in the tables of a scene.
namespace
{
using dem::Vec3;

constexpr double radius = 0.01, step = 1e-6;
/// They press on each other for so long.
constexpr int n_steps = 20;

/// A pyramid of four spheres on a floor, with friction and gravity.
class Pyramid : public testing::Test
{
protected:
  Pyramid()
  {
    dem::EngineParameters p = support::bare_parameters();
    p.particle.shear_modulus = 1e8;
    p.particle.friction = p.wall.friction = 0.5;
    p.particle.normal_damping = p.wall.normal_damping = 0.3;
    p.wall.normal_stiffness = 1e5;
    p.wall.shear_stiffness = 8e4;
    p.gravity = {0., 0., -9.81};
    engine = std::make_unique<dem::Engine>(p);
    dem::add_plane(*engine, Vec3::Zero(), Vec3::UnitZ());
    const double side = 1.9999 * radius, h = std::sqrt(3.) / 2. * side;
    // The uppermost first: rows and ids of neighbours differ.
    support::add_sphere(
        *engine, radius,
        {0.5 * side, h / 3., radius + std::sqrt(2. / 3.) * side});
    support::add_sphere(*engine, radius, {0., 0., 0.99999 * radius});
    support::add_sphere(*engine, radius, {side, 0., 0.99999 * radius});
    support::add_sphere(*engine, radius, {0.5 * side, h, 0.99999 * radius});
    support::advance(*engine, step, n_steps);
  }

  template <class Number>
  std::vector<Number> column(const std::string &group,
                             const std::string &name) const
  {
    for (const dem::TableGroup &table : tables().groups)
      if (table.name == group)
        for (const dem::TableColumn &one : table.columns)
          if (one.name == name)
            return std::get<std::vector<Number>>(one.values);
    ADD_FAILURE() << group << "/" << name;
    return {};
  }
  Vec3 vector(const std::string &group, const std::string &name,
              std::size_t row) const
  {
    const auto all = column<double>(group, name);
    return {all.at(3 * row), all.at(3 * row + 1), all.at(3 * row + 2)};
  }
  dem::TableFile tables() const
  {
    return dem::frame_tables(*engine, {.title = "four",
                                       .kind = "scene",
                                       .program = "1.2.3",
                                       .number = 5,
                                       .plane_names = {"floor"}});
  }

  std::unique_ptr<dem::Engine> engine;
};

TEST_F(Pyramid, EveryColumnHasAUnitThatItsNameEndsWith)
{
  const std::map<std::string, std::string> endings = {{"m", "_m"},
                                                      {"m/s", "_m_per_s"},
                                                      {"rad/s", "_rad_per_s"},
                                                      {"kg", "_kg"},
                                                      {"m^3", "_m3"},
                                                      {"N", "_N"},
                                                      {"Pa", "_Pa"},
                                                      {"1", ""}};
  for (const dem::TableGroup &table : tables().groups)
    for (const dem::TableColumn &one : table.columns)
    {
      EXPECT_TRUE(one.name.ends_with(endings.at(one.unit))) << one.name;
      EXPECT_TRUE(one.sentence.ends_with('.')) << one.name;
    }
}

TEST_F(Pyramid, ParticlesAreThoseOfTheEngine)
{
  const dem::ParticleSystem &all = engine->particles();
  ASSERT_EQ(column<std::int64_t>("particles", "id"),
            (std::vector<std::int64_t>{0, 1, 2, 3}));
  for (std::size_t row = 0; row < all.size(); ++row)
  {
    const auto k = static_cast<std::size_t>(all.id[row]);
    EXPECT_EQ(vector("particles", "position_m", k), all.position(row));
    EXPECT_EQ(vector("particles", "velocity_m_per_s", k), all.velocity(row));
    EXPECT_EQ(column<double>("particles", "mass_kg").at(k),
              all.solid_mass(row));
  }
  EXPECT_EQ(column<std::int32_t>("particles", "coordination_number_1"),
            (std::vector<std::int32_t>{3, 3, 3, 3}));
  EXPECT_EQ(column<std::int32_t>("particles", "shape"),
            (std::vector<std::int32_t>{-1, -1, -1, -1}));
  for (const double removed : column<double>("particles", "removed_volume_m3"))
    EXPECT_EQ(removed, 0.);
}

// Forces and moments of the rows are the loads of the particles; the spheres do
// not roll on their contacts.
TEST_F(Pyramid, ContactsAddUpToTheLoads)
{
  const auto a = column<std::int64_t>("contacts", "a_id"),
             b = column<std::int64_t>("contacts", "b_id");
  const auto pressing = column<double>("contacts", "normal_force_N");
  ASSERT_EQ(a.size(), 9u);
  std::vector<Vec3> force(4, Vec3::Zero());
  for (std::size_t k = 0; k < a.size(); ++k)
  {
    const Vec3 normal = vector("contacts", "normal_1", k),
               shear = vector("contacts", "shear_force_N", k);
    const Vec3 on_a = shear - pressing[k] * normal;
    EXPECT_NEAR(normal.norm(), 1., 1e-15);
    EXPECT_NEAR(shear.dot(normal), 0., 1e-15 * (1. + pressing[k]));
    EXPECT_GT(pressing[k], 0.);
    force.at(static_cast<std::size_t>(a[k])) += on_a;
    if (b[k] >= 0)
      force.at(static_cast<std::size_t>(b[k])) -= on_a;
  }
  const dem::ParticleSystem &all = engine->particles();
  for (std::size_t row = 0; row < all.size(); ++row)
  {
    // Dashpots are kept to seven digits.
    const Vec3 &load = all.load[row].force;
    const Vec3 &sum = force[static_cast<std::size_t>(all.id[row])];
    EXPECT_NEAR((sum - load).norm(), 0., 1e-6 * pressing[0]) << row;
  }
}

// The floor carries the contacts of its rows, and they are on it.
TEST_F(Pyramid, ContactsOnTheFloorAreItsLoad)
{
  const auto kind = column<std::int32_t>("contacts", "kind"),
             boundary = column<std::int32_t>("contacts", "boundary");
  const auto b = column<std::int64_t>("contacts", "b_id");
  const auto pressing = column<double>("contacts", "normal_force_N");
  EXPECT_EQ(column<std::string>("boundaries", "name"),
            (std::vector<std::string>{"floor"}));
  double sum = 0.;
  for (std::size_t k = 0; k < kind.size(); ++k)
  {
    EXPECT_EQ(b[k] == -1, kind[k] == 1);
    EXPECT_EQ(boundary[k], kind[k] == 1 ? 0 : -1);
    if (kind[k] != 1)
      continue;
    sum += pressing[k];
    EXPECT_EQ(vector("contacts", "normal_1", k), -Vec3::UnitZ());
    EXPECT_NEAR(vector("contacts", "point_m", k).z(), 0., 1e-15);
  }
  EXPECT_NEAR(sum, -dem::planes(*engine)[0].force.z(), 1e-12 * sum);
}

// The trace of the stress: sum of the virial of all contacts over the volume.
TEST_F(Pyramid, StressIsThatOfTheRows)
{
  const auto a = column<std::int64_t>("contacts", "a_id"),
             b = column<std::int64_t>("contacts", "b_id");
  const auto pressing = column<double>("contacts", "normal_force_N"),
             stress = column<double>("particles", "stress_Pa");
  double trace = 0.;
  for (std::size_t k = 0; k < a.size(); ++k)
    if (a[k] == 0 || b[k] == 0)
    {
      const double sign = a[k] == 0 ? 1. : -1.;
      const Vec3 on_top =
          sign * (vector("contacts", "shear_force_N", k) -
                  pressing[k] * vector("contacts", "normal_1", k));
      trace -= on_top.dot(vector("contacts", "point_m", k) -
                          vector("particles", "position_m", 0));
    }
  const double volume = column<double>("particles", "volume_m3")[0];
  EXPECT_NEAR(stress[0] + stress[1] + stress[2], trace / volume,
              1e-9 * trace / volume);
}

TEST_F(Pyramid, AttributesDescribeTheFrame)
{
  const dem::TableFile file = tables();
  const std::map<std::string, dem::TableFile::Attribute> all(
      file.attributes.begin(), file.attributes.end());
  EXPECT_EQ(std::get<std::string>(all.at("schema")), "spall_frame_tables");
  EXPECT_EQ(std::get<std::int64_t>(all.at("schema_version")),
            dem::frame_tables_version);
  EXPECT_EQ(std::get<std::string>(all.at("case_title")), "four");
  EXPECT_EQ(std::get<std::string>(all.at("spall_version")), "1.2.3");
  EXPECT_EQ(std::get<std::int64_t>(all.at("frame")), 5);
  EXPECT_EQ(std::get<std::int64_t>(all.at("step")), n_steps);
  EXPECT_EQ(std::get<double>(all.at("time_s")), engine->time());
}
} // namespace
