// Rows of the history, decisions and checks of the step are sums over what each
// rank has: none of them copies the whole scene, and they equal direct sums
// over such a copy.
#include "case/file.h"
#include "test/test.h"
#include "test_folder.h"

#include <dem/measure/assembly.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace
{
namespace fs = std::filesystem;

std::unique_ptr<spall::Test> small_test(const std::string &text)
{
  const fs::path folder = support::test_folder();
  std::ofstream(folder / "particles.csv")
      << "diameter_m,passing_1\n0.010,0\n0.012,1\n";
  const fs::path file = folder / "case.prm";
  std::ofstream(file) << text;
  return spall::make_test(spall::read_case(file.string(), {}));
}

/// Steps with a check of the contacts, then all that a row needs.
void expect_no_copy(spall::Test &test)
{
  constexpr int n_steps = 230; // the check comes every 200
  const int at_setup = test.n_scene_copies();
  for (int step = 0; step < n_steps; ++step)
    test.advance();
  test.engine().synchronize();
  EXPECT_GT(test.row().size(), 10u);
  EXPECT_EQ(test.take_row().size(), test.row().size());
  test.own_ledger();
  test.live_numbers();
  test.energy_balance();
  test.warnings();
  test.outcome();
  EXPECT_EQ(test.n_scene_copies(), at_setup);
  test.gather_scene();
  EXPECT_EQ(test.n_scene_copies(), at_setup + 1);
}

/// Values of a row by their names.
std::map<std::string, double> row_of(const spall::Test &test)
{
  std::map<std::string, double> values;
  for (const spall::Quantity &one : test.row())
    values.emplace(one.name, one.value);
  return values;
}

/// The same quantities by plain loops over a copy of the whole scene.
std::map<std::string, double> directly(const spall::Test &test)
{
  test.gather_scene();
  const dem::ParticleSystem &all = test.whole().particles();
  const dem::ContactBatch &pairs = test.whole().pairs();
  std::map<std::pair<std::int32_t, std::int32_t>, dem::Vec3> forces;
  for (std::size_t k = 0; k < pairs.size(); ++k)
    forces.try_emplace({pairs.a[k], pairs.b[k]}, dem::Vec3::Zero())
        .first->second += dem::pair_force(all, pairs, k);
  std::vector<int> n_of(all.size(), 0);
  double n_contacts = 0., sum_of_forces = 0.;
  for (const auto &[pair, force] : forces)
    if (!force.isZero(0.))
    {
      ++n_contacts;
      sum_of_forces += force.norm();
      ++n_of[static_cast<std::size_t>(pair.first)];
      ++n_of[static_cast<std::size_t>(pair.second)];
    }
  double kinetic = 0., unbalanced = 0., n_bearing = 0., n_ends = 0.;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    kinetic += all.kinetic_energy(i);
    unbalanced += all.load[i].force.norm();
    n_bearing += n_of[i] > 1 ? 1. : 0.;
    n_ends += n_of[i] > 1 ? n_of[i] : 0.;
  }
  const double mean_force = sum_of_forces / n_contacts;
  return {{"n_contacts_1", n_contacts},
          {"mean_contact_force_N", mean_force},
          {"coordination_number_1", n_ends / n_bearing},
          {"kinetic_energy_J", kinetic},
          {"unbalanced_force_ratio_1",
           unbalanced / static_cast<double>(all.size()) / mean_force}};
}

const char *const small_triaxial = R"(
subsection Case
  set kind = dynamic_triaxial
end
subsection Specimen
  set side = 0.04
  set gradation = particles.csv
  set initial_solid_fraction = 0.25
end
subsection Boundary
  set lateral = rigid
end
subsection Wall
  set normal_stiffness = 1e6
  set shear_stiffness = 1e6
end
subsection Time
  set step = stable
end
)";

TEST(Rows, OfATriaxialTestCopyNoScene)
{
  const auto test = small_test(small_triaxial);
  expect_no_copy(*test);
}

// Sums of some hundred terms differ by their order alone.
TEST(Rows, AreSumsOverAllParticlesAndContacts)
{
  const auto test = small_test(small_triaxial);
  constexpr int most_steps = 20000;
  for (int step = 0; step < most_steps; ++step)
  {
    test->advance();
    if (step % 100 == 0 && row_of(*test).at("n_contacts_1") > 30.)
      break;
  }
  const std::map<std::string, double> row = row_of(*test);
  ASSERT_TRUE(test->is_preparing()); // no plate with a motion of its own
  EXPECT_GT(row.at("n_contacts_1"), 30.);
  for (const auto &[name, value] : directly(*test))
    EXPECT_NEAR(row.at(name), value, 1e-12 * value) << name;
}

TEST(Rows, OfADrumCopyNoScene)
{
  const auto test = small_test(R"(
subsection Case
  set kind = los_angeles
end
subsection Charge
  set mass = 0.2
  set balls = 1
  set ball_mass = 0.4
  set ball_shear_modulus = 1e9
end
subsection Drum
  set radius = 0.2
  set length = 0.2
  set lifter_height = 0.05
  set settling_time = 0.3
end
)");
  expect_no_copy(*test);
}

TEST(Rows, OfASceneCopyNoScene)
{
  const auto test = small_test(R"(
subsection Case
  set kind = scene
end
subsection Fill
  set mass = 0.2
  set gradation = gradations/los_angeles_20_45mm.csv
end
)");
  expect_no_copy(*test);
}

TEST(Rows, OfACompactionCopyNoScene)
{
  const auto test = small_test(R"(
subsection Case
  set kind = vibratory_compaction
end
subsection Container
  set diameter = 0.05
  set height = 0.04
end
subsection Filling
  set gradation = particles.csv
  set layers = 1
  set density = 1300
end
)");
  expect_no_copy(*test);
}

TEST(Rows, OfASubgradeCopyNoScene)
{
  const auto test = small_test(R"(
subsection Case
  set kind = subgrade
end
subsection Layer
  set length = 0.2
  set width = 0.2
  set thickness = 0.06
  set gradation = gradations/los_angeles_20_45mm.csv
  set shapes =
end
subsection LoadPlate
  set diameter = 0.14
end
subsection Subgrade
  set length = 0.8
  set width = 0.8
  set layers = 0.1 40e6 0.3 1900, 0.4 20e6 0.3 1800
  set cell_size = 0.05
  set growth = 1.6
end
subsection Record
  set stress_depths = 0.05 0.2
end
subsection Coupling
  set exchange = one_pass
  set particle_steps = 3
end
subsection Wall
  set normal_stiffness = 2e6
  set shear_stiffness = 1.7e6
end
subsection Time
  set fixed_step = 1e-5
end
)");
  expect_no_copy(*test);
}
} // namespace
