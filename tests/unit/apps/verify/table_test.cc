#include <gtest/gtest.h>

#include <cmath>
#include <commands/commands.h>
#include <errors.h>
#include <set>
#include <sstream>
#include <verify/families.h>
#include <verify/table.h>

using namespace spall;
using namespace spall::verify;

namespace
{
std::vector<Row> two_rows()
{
  return {{"held", "m", 2., 2.01, 0.01},
          {"fails, \"by far\"", "m", 2., 2.03, 0.01}};
}

const Family made_up = {"made_up", "Two rows.", {{"one", "by hand", two_rows}}};

int verify_with(std::vector<std::string> words)
{
  testing::internal::CaptureStdout();
  const int status = verify_command(words);
  testing::internal::GetCapturedStdout();
  return status;
}
} // namespace

TEST(VerifyRow, ErrorIsOverTheReferenceOrTheScale)
{
  EXPECT_DOUBLE_EQ(error_of({"q", "m", -4., -5., 0.}), 0.25);
  EXPECT_DOUBLE_EQ(error_of({"q", "m", -4., -5., 0., 2.}), 0.5);
  EXPECT_DOUBLE_EQ(error_of(at_most("q", "m", -0.5, 1.)), 0.5);
}

TEST(VerifyRow, IsHeldUpToItsTolerance)
{
  EXPECT_TRUE(is_held({"q", "m", 1., 1.25, 0.25}));
  EXPECT_FALSE(is_held({"q", "m", 1., 1.25, 0.24}));
  EXPECT_TRUE(is_held(at_most("q", "m", 0., 0.)));
  EXPECT_FALSE(is_held(at_most("q", "m", std::nan(""), 1.)));
}

TEST(VerifyTable, ShowsWhatFails)
{
  const std::vector<Result> results = verify::run(made_up);
  ASSERT_EQ(results.size(), 2u);
  std::ostringstream text, csv, page;
  print_table(results, text);
  write_csv(results, csv);
  write_markdown({&made_up, 1}, results, page);
  EXPECT_EQ(text.str().find("FAILS"), text.str().rfind("FAILS"));
  EXPECT_NE(text.str().find("FAILS"), std::string::npos);
  EXPECT_NE(csv.str().find("made_up,one,\"fails, \"\"by far\"\"\",m,2,"),
            std::string::npos);
  EXPECT_NE(csv.str().find(",0,\"by hand\""), std::string::npos);
  EXPECT_NE(page.str().find("**fails**"), std::string::npos);
}

TEST(VerifyTable, NamesAreUnique)
{
  std::set<std::string> names;
  for (const Family &family : families())
    for (const verify::Case &one : family.cases)
      EXPECT_TRUE(names.insert(family.name + "/" + one.name).second);
}

TEST(VerifyCommand, ListsWithoutRunning)
{
  EXPECT_EQ(verify_with({"--list"}), 0);
}

TEST(VerifyCommand, BadInputIsNamed)
{
  const auto message = [](std::vector<std::string> words) -> std::string
  {
    try
    {
      verify_command(words);
    }
    catch (const InputError &error)
    {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message({"law"}).find("laws, impacts"), std::string::npos);
  EXPECT_NE(message({"--cvs", "a"}).find("--csv FILE"), std::string::npos);
  EXPECT_NE(message({"laws", "--csv"}).find("needs a file"), std::string::npos);
  EXPECT_NE(message({"shape", "--page", "/nowhere/a.md"}).find("a.md"),
            std::string::npos);
}
