#include "case/case.h"
#include "errors.h"
#include "test_folder.h"
#include "triaxial/load_path.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace
{
using namespace spall;

Case rigid_case()
{
  Case c = default_case("dynamic_triaxial");
  c.boundary.lateral = Lateral::rigid;
  return c;
}

LoadPath path_of(const std::string &text)
{
  const auto file = support::test_folder() / "load_path_test.csv";
  std::ofstream(file) << text;
  return read_load_path(file.string(), rigid_case());
}
} // namespace

TEST(LoadPath, ReadsStagesAndKeepsEmptyCells)
{
  const LoadPath path =
      path_of("# two stages\nname,axial_stress_Pa,duration_s,wave,"
              "amplitude_Pa,frequency_Hz,cycles_1,section,y_strain_1\n"
              "ramp,6e4,0.1,,,,,,0.01\n\n"
              " block , , ,square,2e4,25,4,first,\n");
  ASSERT_EQ(path.stages.size(), 2u);
  const LoadStage &ramp = path.stages[0], &block = path.stages[1];
  EXPECT_EQ(ramp.axial.control, LoadControl::stress);
  EXPECT_EQ(*ramp.axial.target, 6e4);
  EXPECT_FALSE(ramp.axial.rate);
  EXPECT_EQ(ramp.sides[0].control, LoadControl::keep);
  EXPECT_EQ(*ramp.sides[1].target, 0.01);
  EXPECT_EQ(block.name, "block");
  EXPECT_EQ(block.wave.form, WaveForm::square);
  EXPECT_TRUE(block.is_over_first_section);
  EXPECT_EQ(path.n_cycles(), 5);
}

// With p = (a + 2 l) / 3 and q = a - l: dl / da = (3 - s) / (3 + 2 s).
TEST(LoadPath, SlopesAreRatiosOfTheSides)
{
  const LoadPath path =
      path_of("duration_s,lateral_rule,dq_over_dp_1,lateral_over_axial_1\n"
              "1,constant_p,,\n1,,3,\n1,,0,\n1,,1.5,\n1,,,0.4\n"
              "1,constant_volume,,\n");
  const double expected[] = {-0.5, 0., 1., 0.25, 0.4};
  for (std::size_t k = 0; k < 5; ++k)
  {
    EXPECT_EQ(path.stages[k].rule, SideRule::proportional);
    EXPECT_DOUBLE_EQ(path.stages[k].side_ratio, expected[k]) << k;
  }
  EXPECT_EQ(path.stages[5].rule, SideRule::constant_volume);
}

TEST(LoadPath, LengthsAreThoseOfTargetsAndRates)
{
  const LoadPath path =
      path_of("axial_stress_Pa,axial_stress_rate_Pa_per_s,lateral_stress_Pa,"
              "axial_strain_1,axial_strain_rate_1_per_s,duration_s\n"
              "8e4,1e5,6e4,,,\n,,,0.02,0.1,\n,,,0.01,-0.1,\n,,,,,0.3\n");
  const std::vector<double> periods = expected_periods(path, 30e3);
  const double expected[] = {0.5, 0.2, 0.1, 0.3};
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_NEAR(periods[k], expected[k], 1e-12) << k;
}

TEST(LoadPath, ShortFormsAreOneStage)
{
  Case c = rigid_case();
  const LoadPath cyclic = load_path_of(c);
  ASSERT_EQ(cyclic.stages.size(), 1u);
  EXPECT_EQ(cyclic.stages[0].wave.form, WaveForm::haversine);
  EXPECT_EQ(cyclic.stages[0].amplitude, c.loading.amplitude);
  EXPECT_EQ(cyclic.n_cycles(), c.loading.cycles);
  c.loading.form = LoadForm::compression;
  const LoadPath monotonic = load_path_of(c);
  EXPECT_FALSE(monotonic.has_waves());
  EXPECT_DOUBLE_EQ(expected_periods(monotonic, 30e3).front(),
                   c.loading.final_strain / c.loading.strain_rate);
}

TEST(LoadPath, FaultsNameLineColumnAndValue)
{
  try
  {
    path_of("name,duration_s\na,0.1\nb,soon\n");
    FAIL();
  }
  catch (const InputError &error)
  {
    const std::string text = error.what();
    EXPECT_NE(text.find(".csv:3: duration_s = soon: "), std::string::npos)
        << text;
    EXPECT_NE(text.find("above 0"), std::string::npos) << text;
  }
}
