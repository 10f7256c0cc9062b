#include "errors.h"
#include "report/chart.h"
#include "report/chart_table.h"
#include "report/figures.h"
#include "report/run_data.h"
#include "report/text.h"
#include "test_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

namespace
{
using namespace spall;

const double nan_value = std::numeric_limits<double>::quiet_NaN();

std::string write(const std::string &name, const std::string &content)
{
  const auto path = support::test_folder() / name;
  std::ofstream(path) << content;
  return path.string();
}

TEST(ReportText, EscapesAllThatHtmlReads)
{
  EXPECT_EQ(escape("a<b>&\"'c"), "a&lt;b&gt;&amp;&quot;&#39;c");
}

TEST(ReportText, FormatsNumbers)
{
  EXPECT_EQ(format(0.5, 3), "0.500");
  EXPECT_EQ(format(-12.345, 3), "\u221212.3");
  EXPECT_EQ(format(1234.4, 3), "1234");
  EXPECT_EQ(format(0., 2), "0.0");
  EXPECT_EQ(format(3.14e-15, 2), "3.1·10⁻¹⁵");
  EXPECT_EQ(format(-2e7, 1), "\u22122·10⁷");
  EXPECT_EQ(format(nan_value, 3), "–");
  EXPECT_EQ(format_fixed(-0.001, 1), "0.0");
}

// The test vectors of RFC 4648.
TEST(ReportText, Base64)
{
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe"), "//4=");
}

TEST(ReportTable, FindsColumnsByNameAndDropsBrokenLines)
{
  const Table table = read_table(
      write("table.csv", "b_1,a_m\r\n1,2.5e-3\r\n3,nan\n4,x\n5\n6,7,8\n9,"));
  ASSERT_EQ(table.n_rows(), 2u);
  EXPECT_EQ(table.n_dropped, 4u);
  ASSERT_TRUE(table.find("a_m"));
  EXPECT_EQ((*table.find("a_m"))[0], 2.5e-3);
  EXPECT_TRUE(std::isnan((*table.find("a_m"))[1]));
  EXPECT_EQ((*table.find("b_1"))[1], 3.);
  EXPECT_EQ(table.find("c"), nullptr);
}

TEST(ReportTable, EmptyFileThrows)
{
  EXPECT_THROW(read_table(write("empty.csv", "")), InputError);
  EXPECT_THROW(read_table("missing.csv"), InputError);
}

TEST(ReportTable, EndsOfCyclesAreTheSamplesMeantForThem)
{
  // 0.9999 was meant for 1; cycle 3 has not ended.
  Table loading{{"cycle_1"}, {{0., 0.5, 0.9999, 1.5, 2.0001, 2.5}}};
  EXPECT_EQ(cycle_ends(loading), (std::vector<std::size_t>{0, 2, 4}));
  loading.columns[0].push_back(3.);
  EXPECT_EQ(cycle_ends(loading), (std::vector<std::size_t>{0, 2, 4, 6}));
  EXPECT_TRUE(cycle_ends({{"cycle_1"}, {{}}}).empty());
  EXPECT_TRUE(cycle_ends({{"time_s"}, {{1.}}}).empty());
}

void expect_axis(const Axis &axis, double low, double high, double step)
{
  EXPECT_NEAR(axis.low, low, 1e-9 * step);
  EXPECT_NEAR(axis.high, high, 1e-9 * step);
  EXPECT_NEAR(axis.step, step, 1e-9 * step);
}

TEST(ReportChart, AxesHaveRoundTicksAroundTheData)
{
  expect_axis(nice_axis(0., 10., 6), 0., 10., 2.);
  expect_axis(nice_axis(-13.2, 96.7, 5), -20., 100., 20.);
  // A tick far beyond the data would waste space.
  expect_axis(nice_axis(-1., 17., 6), -2., 18., 5.);
  expect_axis(nice_axis(0.512, 0.516, 5), 0.512, 0.516, 0.001);
  // Zero is near: it is taken in.
  expect_axis(nice_axis(2., 9.7, 5), 0., 10., 2.);
}

TEST(ReportChart, DecadesCoverTheData)
{
  expect_axis(decade_axis(0.003, 20.), -3., 2., 1.);
  expect_axis(decade_axis(0.1, 100.), -1., 2., 1.);
  expect_axis(decade_axis(5., 5.), 0., 1., 1.);
  EXPECT_TRUE(decade_axis(1., 2.).is_log);
}

// Three decades: the middle one of a curve is at two thirds of the height, and
// what has no logarithm is not drawn.
TEST(ReportChart, LogarithmicAxesAreEvenInDecades)
{
  Chart chart{"c", ReportSection::response, "C.", "x (m)", "y (m)"};
  chart.has_log_y = true;
  Curve curve;
  curve.line_width = 0.;
  curve.marker = Marker::dot;
  curve.x = {0., 1., 2., 3.};
  curve.y = {1e-3, 1e-2, 0., 1.};
  chart.curves.push_back(curve);
  std::istringstream lines(draw(chart));
  std::vector<double> height;
  for (std::string text; std::getline(lines, text);)
    if (const auto at = text.find("cy=\""); at != std::string::npos)
      height.push_back(std::stod(text.substr(at + 4)));
  ASSERT_EQ(height.size(), 3u);
  EXPECT_NEAR((height[1] - height[0]) / (height[2] - height[0]), 1. / 3., 2e-3);
  EXPECT_NE(draw(chart).find("10\u207b\u00b3"), std::string::npos);
}

TEST(ReportChart, NamesStandAtWholeNumbers)
{
  Chart chart{"c", ReportSection::response, "C.", "x", "y"};
  chart.x_names = {"soft", "stiff"};
  Curve curve;
  curve.x = {1., 2.};
  curve.y = {3., 4.};
  chart.curves.push_back(curve);
  const std::string svg = draw(chart);
  EXPECT_NE(svg.find(">soft</text>"), std::string::npos);
  EXPECT_NE(svg.find(">stiff</text>"), std::string::npos);
}

TEST(ReportChart, ConstantAndAbsentDataHaveAnAxis)
{
  const Axis constant = nice_axis(3., 3., 5);
  EXPECT_LT(constant.low, 3.);
  EXPECT_GT(constant.high, 3.);
  const Axis zero = nice_axis(0., 0., 5);
  EXPECT_LT(zero.low, zero.high);
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(nice_axis(infinity, -infinity, 5).high, 1.);
}

TEST(ReportChart, DrawsLabelsAndLegendAsEscapedText)
{
  Chart chart{"id", ReportSection::response, "caption", "x <label>", "y"};
  chart.curves = {{"first", {0., 1.}, {0., 1.}},
                  {"second & last", {0., 1.}, {1., 0.}}};
  const std::string svg = draw(chart);
  EXPECT_NE(svg.find("x &lt;label&gt;"), std::string::npos);
  EXPECT_NE(svg.find("second &amp; last"), std::string::npos);
  EXPECT_EQ(svg.find("xmlns"), std::string::npos);
  EXPECT_NE(svg_file(svg).find("<svg xmlns="), std::string::npos);
}

TEST(ReportChart, NanInterruptsTheLine)
{
  Chart chart{"id", ReportSection::response, "caption", "x", "y"};
  chart.curves = {{"", {0., 1., nan_value, 2., 3.}, {0., 1., 1., 2., 3.}}};
  const std::string svg = draw(chart);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  const std::string path = svg.substr(svg.rfind("<path d="));
  EXPECT_EQ(std::count(path.begin(), path.end(), 'M'), 2);
  EXPECT_EQ(std::count(path.begin(), path.end(), 'L'), 2);
}

TEST(ReportTables, ColumnsAreNamedByQuantityAndUnit)
{
  EXPECT_EQ(column_name("Axial strain (%)"), "axial_strain_percent");
  EXPECT_EQ(column_name("Density (kg/m³)"), "density_kg_per_m3");
  EXPECT_EQ(column_name("Cycle N (–)"), "cycle_n_1");
  EXPECT_EQ(column_name("Torque (N m)"), "torque_Nm");
  EXPECT_EQ(column_name("Mobility (mm/s per kN)"), "mobility_mm_per_s_per_kN");
}

TEST(ReportTables, HoldTheDrawnPointsOfTheCurvesWithNumbersOfTheirOwn)
{
  Chart chart{"id", ReportSection::response, "C.", "Time (s)", "Force (N)"};
  Curve many, bars, named;
  for (int k = 0; k <= 10000; ++k)
  {
    many.x.push_back(k / 10000.);
    many.y.push_back(k);
  }
  many.csv_name = "a, b";
  bars.x = {0., 0.5};
  bars.y = {0., 5000.};
  bars.is_in_csv = false;
  named.name = "points";
  named.x = {0.25, nan_value, 1.};
  named.y = {2500., 1., 10000.};
  named.marker = Marker::dot;
  named.shift = 0.1;
  chart.curves = {many, bars, named};
  const ChartTable table = table_of(chart);
  EXPECT_EQ(table.n_points, 10003u);
  EXPECT_LT(table.n_rows, 2000u);
  EXPECT_EQ(table.csv.find("curve,time_s,force_N\n\"a, b\",0,0\n"), 0u);
  // The last point of a line is never left out; a shift is for the eye.
  EXPECT_NE(table.csv.find("\"a, b\",1,10000\npoints,0.25,2500\npoints,1,"),
            std::string::npos);
}

const Chart &find_chart(const std::vector<Chart> &charts, const std::string &id)
{
  return *std::find_if(charts.begin(), charts.end(),
                       [&](const Chart &chart) { return chart.id == id; });
}

TEST(ReportFigures, PermanentStrainIsTakenAtTheEndsOfTheCycles)
{
  RunData run;
  run.name = "run";
  run.loading = {{"cycle_1", "axial_strain_1"},
                 {{0., 0.5, 1., 1.5, 2.}, {0., 0.02, 0.01, 0.03, 0.015}}};
  const std::vector<Chart> charts = make_charts({&run, 1});
  const Chart &chart = find_chart(charts, "permanent_axial_strain");
  ASSERT_EQ(chart.curves.size(), 1u);
  EXPECT_EQ(chart.curves[0].x, (std::vector<double>{0., 1., 2.}));
  EXPECT_EQ(chart.curves[0].y, (std::vector<double>{0., 1., 1.5})); // [%]
  EXPECT_TRUE(find_chart(charts, "abrasion").curves.empty());
  EXPECT_EQ(find_chart(charts, "abrasion").notes.at(0),
            "run: no column laa_percent.");
}

TEST(ReportFigures, CyclesOfOneRunShowRestAndLoad)
{
  RunData run;
  run.name = "run";
  for (const Chart &chart : make_charts({&run, 1}))
    EXPECT_NE(chart.id, "force_chains");
  run.cycles = {{"cycle_1", "force_chain_share_1", "force_chain_share_peak_1"},
                {{1., 2.}, {0.1, 0.2}, {0.3, 0.4}}};
  const std::vector<Chart> charts = make_charts({&run, 1});
  const Chart &chart = find_chart(charts, "force_chains");
  ASSERT_EQ(chart.curves.size(), 2u);
  EXPECT_EQ(chart.curves[0].y, (std::vector<double>{10., 20.})); // [%]
  EXPECT_EQ(chart.curves[1].y, (std::vector<double>{30., 40.}));
  EXPECT_EQ(find_chart(charts, "damping_ratio").notes.at(0),
            "run: no column damping_ratio_1.");
  // Several runs in one chart, each by one curve.
  const std::vector<RunData> runs(2, run);
  const std::vector<Chart> both = make_charts(runs);
  EXPECT_EQ(find_chart(both, "force_chains").curves.size(), 2u);
}

TEST(ReportFigures, ProfilesAreThoseOfStartAndEnd)
{
  RunData run;
  run.name = "run";
  run.profile_start = {{"distance_m", "porosity_lateral_1"},
                       {{1e-3, 3e-3}, {0.6, 0.4}}};
  run.profile_end = run.profile_start;
  const std::vector<Chart> charts = make_charts({&run, 1});
  const Chart &chart = find_chart(charts, "porosity_lateral");
  ASSERT_EQ(chart.curves.size(), 2u);
  EXPECT_EQ(chart.curves[0].x, (std::vector<double>{1., 3.})); // [mm]
  EXPECT_EQ(chart.curves[1].y, (std::vector<double>{60., 40.}));
}
} // namespace
