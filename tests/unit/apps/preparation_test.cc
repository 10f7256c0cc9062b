#include "case/fields.h"
#include "test_folder.h"
#include "triaxial/preparation.h"
#include "triaxial/triaxial.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

namespace
{
using namespace spall;
namespace fs = std::filesystem;

/// Another value that is allowed too.
void change(const Parameter &parameter)
{
  if (auto *const *number = std::get_if<double *>(&parameter.value))
    **number = **number == 0. ? 0.01 : 0.99 * **number;
  else if (auto *const *count = std::get_if<int *>(&parameter.value))
    ++**count;
  else if (auto *const *flag = std::get_if<bool *>(&parameter.value))
    **flag = !**flag;
  else if (auto *const *text = std::get_if<std::string *>(&parameter.value))
    **text += "x";
  else if (const Choice *choice = std::get_if<Choice>(&parameter.value))
    choice->set((choice->get() + 1) % choice->names.size());
}

/// Whether a triaxial test has the parameter.
bool has_key(const Parameter &parameter)
{
  for (const ListedSection &section : sections(Case{}))
    if (section.name == parameter.section)
      return section.is_of("dynamic_triaxial") &&
             parameter.is_of("dynamic_triaxial");
  return false;
}

/// Whether it comes into play after the preparation only.
bool is_later(const Parameter &parameter)
{
  return !parameter.decides_preparation ||
         parameter.name() == "Particle/friction";
}

/// Some twenty particles that are soon together.
class Preparation : public testing::Test
{
protected:
  void SetUp() override
  {
    folder = support::test_folder();
    std::ofstream(folder / "g.csv")
        << "diameter_m,passing_1\n0.010,0\n0.012,1\n";
    base.file = (folder / "case.prm").string();
    base.specimen.side = 0.025;
    base.specimen.gradation = "g.csv";
    base.specimen.shapes = SPALL_SHAPES_DIR "/limestone_blocky";
    base.specimen.initial_solid_fraction = 0.25;
    base.preparation.wall_speed = 2.;
    base.coupling.exchange = ExchangeChoice::every_step;
    base.time.step = StepRule::stable;
    base.wall.normal_stiffness = base.wall.shear_stiffness = 1e6;
  }

  std::string text_of(const Case &parameters) const
  {
    return specimen_text(parameters, load_shapes(parameters, "Specimen",
                                                 parameters.specimen.shapes));
  }

  fs::path folder;
  Case base;
};

/// Position and velocity of every particle after these steps, the energies
/// besides.
std::vector<double> after(const Case &parameters, int n_steps)
{
  Triaxial test(parameters);
  for (int k = 0; k < n_steps; ++k)
    test.advance();
  EXPECT_EQ(test.stage(), Stage::preparation);
  test.engine().synchronize();
  const dem::EngineEnergy energy = test.engine().energy();
  std::vector<double> all = {energy.friction, energy.rolling, energy.damping,
                             energy.elastic, energy.breakage};
  const dem::ParticleSystem &particles = test.engine().particles();
  for (std::size_t i = 0; i < particles.size(); ++i)
    for (int d = 0; d < 3; ++d)
      for (const double value :
           {particles.position(i)[d], particles.velocity(i)[d]})
        all.push_back(value);
  return all;
}
} // namespace

TEST_F(Preparation, TextFollowsTheKeysThatDecideAndNoOthers)
{
  base.breakage.inscribed = dem::InscribedSphereAt::free; // needs the rings
  const std::string before = text_of(base);
  for (std::size_t k = 0; k < parameters_of(base).size(); ++k)
  {
    Case other = base;
    const Parameter parameter = parameters_of(other)[k];
    const std::string name = parameter.name();
    if (name == "Specimen/gradation" || name == "Specimen/shapes" ||
        name == "Specimen/particles")
      continue; // by their contents, see below
    if (name == "Case/kind")
      continue; // another kind prepares in another way
    change(parameter);
    // Of no use: a step that is not fixed, a box, a pressure, the friction of
    // the loading.
    const bool is_unused =
        name == "Particle/friction" || name == "Time/fixed_step" ||
        name == "Specimen/diameter" || name == "Specimen/height" ||
        name == "Preparation/porosity";
    EXPECT_EQ(text_of(other) != before,
              has_key(parameter) && parameter.decides_preparation && !is_unused)
        << name;
  }
}

TEST_F(Preparation, TextFollowsTheContentsOfFilesNotTheirNames)
{
  const std::string before = text_of(base);
  fs::copy(folder / "g.csv", folder / "same.csv");
  Case other = base;
  other.specimen.gradation = "same.csv";
  EXPECT_EQ(text_of(other), before);
  std::ofstream(folder / "g.csv") << "diameter_m,passing_1\n0.01,0\n0.0121,1\n";
  EXPECT_NE(text_of(base), before);
  other.specimen.shapes = SPALL_SHAPES_DIR "/rounded_cube";
  EXPECT_NE(text_of(other), before);
}

// Contacts from early on: the particles meet after some hundred steps.
TEST_F(Preparation, KeysOfLaterLeaveTheSpecimenAsItIs)
{
  constexpr int n_steps = 1500;
  const std::vector<double> before = after(base, n_steps);
  EXPECT_GT(before[2], 0.); // dashpots have worked
  Case others = base;
  for (const Parameter &parameter : parameters_of(others))
    if (has_key(parameter) && is_later(parameter) &&
        parameter.name() != "Case/kind" &&
        parameter.name() != "Boundary/lateral" &&
        parameter.name() != "Boundary/mesh") // there is no such file
      change(parameter);
  others.membrane.poisson_ratio = 0.5; // of its other law
  EXPECT_EQ(after(others, n_steps), before);
  Case rigid = base;
  rigid.boundary.lateral = Lateral::rigid;
  EXPECT_EQ(after(rigid, n_steps), before);
  Case heavier = base;
  heavier.particle.density *= 1.001;
  EXPECT_NE(after(heavier, n_steps), before);
}

// Cases that differ in the steps of their loading, or in how soon contacts and
// lists are renewed then, share a specimen.
TEST_F(Preparation, OwnStepsLeaveTheNumericsOfLoadingOut)
{
  constexpr int n_steps = 1500;
  const std::vector<double> before = after(base, n_steps);
  Case own = base;
  own.preparation.safety = 0.5 * base.time.safety;
  EXPECT_NE(after(own, n_steps), before);
  Case same = own;
  same.preparation.safety = base.time.safety;
  EXPECT_EQ(after(same, n_steps), before);
  Case fixed = same;
  fixed.time.step = StepRule::fixed;
  fixed.time.fixed_step = 1e-6;
  fixed.time.safety = 0.3;
  fixed.contact.refresh_tolerance = 0.;
  fixed.contact.skin = 1e-3;
  EXPECT_EQ(after(fixed, n_steps), before);
  EXPECT_EQ(text_of(fixed), text_of(same));
  EXPECT_NE(text_of(own), text_of(same));
  EXPECT_NE(text_of(base), text_of(same));
}

// Contacts and lists of the loading are renewed as the case says.
TEST_F(Preparation, OwnTolerancesEndWithIt)
{
  base.boundary.lateral = Lateral::rigid;
  base.preparation.stress_tolerance = 0.3;
  base.preparation.unbalanced_ratio = 0.1;
  base.preparation.safety = base.time.safety;
  base.contact.refresh_tolerance = 1e-3;
  base.contact.skin = 2e-4;
  const dem::GeometryParameters usual;
  Triaxial test(base);
  const dem::GeometryParameters &geometry = test.engine().parameters().geometry;
  EXPECT_EQ(geometry.refresh_tolerance, usual.refresh_tolerance);
  EXPECT_EQ(geometry.skin, usual.skin);
  while (test.stage() == Stage::preparation)
    test.advance();
  EXPECT_EQ(geometry.refresh_tolerance, 1e-3);
  EXPECT_EQ(geometry.skin, 2e-4);
}

// What is taken up goes on as what prepared itself.
TEST_F(Preparation, IsTakenUpBitForBit)
{
  base.boundary.lateral = Lateral::rigid;
  base.preparation.stress_tolerance = 0.3;
  base.preparation.unbalanced_ratio = 0.1;
  Triaxial first(base);
  std::ostringstream kept;
  int n_calls = 0;
  first.when_prepared(
      [&]
      {
        ++n_calls;
        first.save_prepared(kept);
      });
  while (first.stage() == Stage::preparation)
    first.advance();
  EXPECT_EQ(n_calls, 1);
  Case other = base;
  other.particle.friction = 0.3;
  for (const Case &parameters : {base, other})
  {
    Triaxial second(parameters);
    std::istringstream in(kept.str());
    second.take_prepared(in);
    EXPECT_EQ(second.stage(), Stage::consolidation);
    EXPECT_EQ(second.prepared().is_taken, 1);
    EXPECT_EQ(second.prepared().hash, first.prepared().hash);
    if (parameters.particle.friction != base.particle.friction)
      continue;
    for (int k = 0; k < 300; ++k)
    {
      first.advance();
      second.advance();
    }
    first.engine().synchronize();
    second.engine().synchronize();
    const Sample a = first.sample(0.), b = second.sample(0.);
    for (const SampleColumn &column : sample_columns)
      EXPECT_EQ(a.*column.value, b.*column.value) << column.name;
  }
}
