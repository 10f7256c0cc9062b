#include "commands/commands.h"
#include "errors.h"
#include "report/section.h"
#include "test_folder.h"

#include <dem/io/vtk_output.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

namespace
{
namespace fs = std::filesystem;

std::string read(const fs::path &path)
{
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

void write(const fs::path &path, const std::string &text)
{
  fs::create_directories(path.parent_path());
  std::ofstream(path) << text;
}

bool has(const std::string &text, const std::string &part)
{
  return text.find(part) != std::string::npos;
}

/// Two particles, four samples a cycle, three cycles; made-up numbers.
std::string made_up_history()
{
  std::ostringstream out;
  out << "laa_percent,time_s,stage_1,cycle_1,axial_stress_Pa,"
         "lateral_stress_Pa,axial_strain_1,volumetric_strain_1,"
         "coordination_number_1,mean_contact_force_N,roundness_1,n_events_1,"
         "external_work_J,friction_dissipation_J,energy_residual_J\n"
         "0,0,0,0,1e4,1e4,0,0,4,1,0.5,0,0,0,0\n"
         "0,0.1,1,0,3e4,3e4,0,0,4.5,1,0.5,0,0,0,0\n";
  for (int k = 0; k <= 12; ++k)
  {
    const double cycle = k / 4., load = std::pow(std::sin(cycle * 3.1416), 2);
    out << 1e-3 * cycle << ',' << 0.1 + cycle / 20. << ",2," << cycle << ','
        << 3e4 + 1e5 * load << ",3e4," << 1e-3 * cycle + 0.002 * load << ','
        << 1e-4 * cycle << ',' << 5. + 0.1 * cycle << ',' << 2. + load << ','
        << 0.5 + 0.001 * cycle << ',' << k << ',' << 0.1 * cycle + load << ','
        << 0.09 * cycle << ',' << 1e-4 * load << '\n';
  }
  return out.str();
}

void write_particles(const std::string &path, double loss)
{
  const std::vector<std::int64_t> ids{0, 1};
  const std::vector<dem::Vec3> positions{{0., 0., 0.}, {0.02, 0., 0.}};
  const std::vector<dem::Quaternion> orientations(2,
                                                  dem::Quaternion::Identity());
  const std::vector<dem::ParticleShape> bodies(2);
  const std::vector<double> radii(2, 0.01), losses{0., loss};
  std::ofstream file(path, std::ios::binary);
  dem::write_surfaces(file, {.id = ids,
                             .position = positions,
                             .velocity = {},
                             .spin = {},
                             .orientation = orientations,
                             .body = bodies,
                             .radius = radii,
                             .mass = {},
                             .loss = losses});
}

const char *const summary =
    R"({"kind": "dynamic_triaxial", "title": "Test <b>&</b>",
  "lateral": "membrane", "n_particles": 2, "n_breakable": 2,
  "permanent_axial_strain_1": 0.01234, "laa_percent": 0.0567,
  "coordination_start_1": 5.0, "coordination_end_1": 5.3,
  "coordination_change_1": 0.321, "n_events": 12,
  "energy_residual_ratio_1": 0.0043, "worst_gain_1": 0.025,
  "preparation": {"stress_Pa": [30100, 29900, 30000]},
  "wall_clock_s": {"preparation": 10.0, "contacts": 30.0, "total": 40.0}})";

class RunFolder : public testing::Test
{
protected:
  RunFolder() : folder(support::test_folder()) { make(folder / "run"); }

  static void make(const fs::path &run)
  {
    write(run / "history.csv", made_up_history());
    write(run / "events.csv",
          "time_s,cycle_1,mode_1,force_before_N,force_after_N\n"
          "0.11,0.3,1,40,12\n0.13,0.6,2,55,20\n");
    write(run / "summary.json", summary);
    write(run / "case.prm", "set Title = a < b & c\n");
  }

  /// Pictures take seconds, so only where they matter.
  void add_frames() const
  {
    const fs::path frames = folder / "run" / "frames";
    fs::create_directories(frames);
    write_particles((frames / "surfaces_00000.vtu").string(), 0.);
    write_particles((frames / "surfaces_00006.vtu").string(), 0.002);
  }

  /// The path that the command prints.
  static std::string report(const std::vector<std::string> &words)
  {
    testing::internal::CaptureStdout();
    const int status = spall::report_command(words);
    const std::string out = testing::internal::GetCapturedStdout();
    EXPECT_EQ(status, 0);
    return out.substr(0, out.find('\n'));
  }

  /// The message of the InputError.
  static std::string refusal(const std::vector<std::string> &words)
  {
    try
    {
      spall::report_command(words);
    }
    catch (const spall::InputError &error)
    {
      return error.what();
    }
    return "no InputError";
  }

  std::string run() const { return (folder / "run").string(); }

  fs::path folder;
};

void expect_self_contained(const std::string &page)
{
  for (const char *outside :
       {"http:", "https:", "<script", "<link", "url(", "@import"})
    EXPECT_FALSE(has(page, outside)) << outside;
  for (auto at = page.find("src=\""); at != std::string::npos;
       at = page.find("src=\"", at + 1))
    EXPECT_EQ(page.substr(at + 5, 5), "data:");
  for (auto at = page.find("href=\""); at != std::string::npos;
       at = page.find("href=\"", at + 1))
    EXPECT_TRUE(page[at + 6] == '#' || page.substr(at + 6, 5) == "data:");
}

TEST_F(RunFolder, PageIsWrittenIntoTheRunWithTheNumbers)
{
  const std::string path = report({run()});
  EXPECT_EQ(fs::path(path), folder / "run" / "report.html");
  const std::string page = read(path);
  for (const char *number :
       {"1.23 %", "0.0567 %", "+0.321", "30.1 / 29.9 / 30.0", "0.025",
        "5.00 → 5.30", "30.0 s (75.0 %)", "0.43"})
    EXPECT_TRUE(has(page, number)) << number;
  for (const char *chart :
       {"stress_strain_loops", "permanent_axial_strain", "abrasion",
        "roundness", "coordination_number", "contact_force", "breakage_forces",
        "energies", "energy_residual"})
    EXPECT_TRUE(has(page, "<figure id=\"" + std::string(chart) + "\">"))
        << chart;
}

// Boundaries have neither rows nor figures here but the gain of the exchange.
TEST_F(RunFolder, ContentsNameTheSectionsThatHaveSomething)
{
  const std::string page = read(report({run()}));
  for (const spall::SectionHeading &heading : spall::section_headings)
  {
    EXPECT_TRUE(has(page, "<a href=\"#" + std::string(heading.id) + "\">" +
                              heading.title + "</a>"))
        << heading.id;
    EXPECT_TRUE(has(page, "<section id=\"" + std::string(heading.id) + "\">"))
        << heading.id;
  }
  write(folder / "run" / "summary.json", "{}");
  const std::string poor = read(report({run()}));
  EXPECT_TRUE(has(poor, "id=\"breakage\""));
  EXPECT_FALSE(has(poor, "id=\"performance\""));
  EXPECT_FALSE(has(poor, "href=\"#performance\""));
}

TEST_F(RunFolder, FiguresStandInTheirSectionsWithTheirNumbers)
{
  const std::string page = read(report({run()}));
  const auto at = [&](const std::string &text) { return page.find(text); };
  EXPECT_LT(at("<section id=\"breakage\">"), at("<figure id=\"abrasion\">"));
  EXPECT_LT(at("<figure id=\"abrasion\">"), at("<section id=\"network\">"));
  EXPECT_LT(at("<section id=\"energy\">"), at("<figure id=\"energies\">"));
  // The abrasion of made_up_history() is 0.001 % a cycle.
  EXPECT_TRUE(has(page, "download=\"abrasion.csv\""));
  EXPECT_TRUE(has(page, "cycle_n_1,abrasion_laa_percent%0A0,0%0A0.25,0.00025"));
  EXPECT_TRUE(has(page, "Plotted: abrasion LAA (%) against cycle N."));
}

TEST_F(RunFolder, InputShowsTheCaseFoldedAndTheCommand)
{
  const std::string page = read(report({run()}));
  EXPECT_TRUE(has(page, "spall run " + run() + "/case.prm --out " + run() +
                            "_repeated"));
  EXPECT_TRUE(has(page, "<details><summary>Resolved case of run"));
}

TEST_F(RunFolder, GradationObtainedIsDrawnBesideTheOneAsked)
{
  const std::string figure = "<figure id=\"gradation\">";
  EXPECT_FALSE(has(read(report({run()})), figure));
  write(folder / "run" / "gradation.csv",
        "diameter_m,asked_passing_1,obtained_passing_1,one_particle_1\n"
        "0.01,0,0,0.001\n0.015,0.5,0.49,0.002\n0.02,1,1,0.003\n");
  const std::string page = read(report({run()}));
  EXPECT_TRUE(has(page, figure));
  EXPECT_TRUE(has(page, "asked"));
  EXPECT_TRUE(has(page, "obtained"));
}

TEST_F(RunFolder, PageIsSelfContainedAndEscaped)
{
  const std::string page = read(report({run()}));
  expect_self_contained(page);
  EXPECT_TRUE(has(page, "a &lt; b &amp; c"));
  EXPECT_TRUE(has(page, "Test &lt;b&gt;&amp;&lt;/b&gt;"));
  EXPECT_FALSE(has(page, "<b>"));
  EXPECT_FALSE(has(page, "nan"));
}

TEST_F(RunFolder, FiguresAreWrittenOnRequest)
{
  add_frames();
  const fs::path figures = folder / "figures";
  const std::string page = report({run(), "--figures", figures.string(),
                                   "--out", (folder / "other.html").string()});
  EXPECT_EQ(fs::path(page), folder / "other.html");
  EXPECT_FALSE(fs::exists(folder / "run" / "report.html"));
  EXPECT_TRUE(has(read(figures / "abrasion.svg"), "xmlns="));
  expect_self_contained(read(page));
  // A machine may have no EGL, a program no pictures.
  const bool is_drawn = has(read(page), "data:image/png;base64,iVBORw0KGgo");
  EXPECT_EQ(is_drawn, fs::exists(figures / "specimen.png"));
  EXPECT_NE(is_drawn, has(read(page), "No picture of run: this "));
}

TEST_F(RunFolder, SeveralRunsShareTheirCharts)
{
  make(folder / "rigid");
  const std::string page =
      read(report({run(), (folder / "rigid").string(), "--out",
                   (folder / "comparison.html").string()}));
  expect_self_contained(page);
  EXPECT_TRUE(has(page, "Comparison of 2 runs"));
  EXPECT_TRUE(has(page, "<th scope=\"col\">rigid</th>"));
  EXPECT_TRUE(has(page, "<figure id=\"energies_2\">"));
}

TEST_F(RunFolder, MissingFilesAndColumnsAreNamedInThePage)
{
  for (const char *name : {"summary.json", "events.csv", "case.prm"})
    fs::remove_all(folder / "run" / name);
  write(folder / "run" / "history.csv",
        "time_s,cycle_1,axial_strain_1\n0,0,0\n1,1,0.05\n");
  const std::string page = read(report({run()}));
  for (const char *note :
       {"no summary.json", "no events.csv", "no case.prm", "No picture of run",
        "no column stage_1", "no column laa_percent", "5.00 %"})
    EXPECT_TRUE(has(page, note)) << note;
}

TEST_F(RunFolder, BrokenSummaryAndSurfacesAreNamedInThePage)
{
  write(folder / "run" / "summary.json", "{\"title\": ");
  add_frames();
  write(folder / "run" / "frames" / "surfaces_00006.vtu", "no XML");
  const std::string page = read(report({run()}));
  EXPECT_TRUE(has(page, "summary.json is not valid JSON"));
  EXPECT_TRUE(has(page, "No picture of run"));
}

TEST_F(RunFolder, BadWordsAndFoldersAreRefusedInOneLine)
{
  write(folder / "no_run" / "other.txt", "");
  const std::string missing = (folder / "missing").string(),
                    no_run = (folder / "no_run").string();
  EXPECT_EQ(refusal({missing}), "report: '" + missing + "' is not a folder");
  EXPECT_EQ(refusal({run(), no_run}),
            "report: '" + no_run +
                "' is not a run folder (it has no history.csv)");
  EXPECT_TRUE(has(refusal({}), "at least one run folder"));
  EXPECT_TRUE(has(refusal({run(), "--outt", "x"}), "unknown option '--outt'"));
  EXPECT_TRUE(has(refusal({run(), "--out"}), "--out needs a file"));
  EXPECT_TRUE(
      has(refusal({run(), "--out", missing + "/a/b.html"}), "be written"));
}
} // namespace
