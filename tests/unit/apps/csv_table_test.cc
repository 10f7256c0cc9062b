#include "errors.h"
#include "specimen/csv_table.h"
#include "test_folder.h"

#include <gtest/gtest.h>

#include <fstream>
#include <utility>

namespace
{
class CsvTableFile : public testing::Test
{
protected:
  const std::string path =
      (support::test_folder() / "csv_table_test.csv").string();

  spall::ColumnPair read(const std::string &text) const
  {
    std::ofstream(path) << text;
    return spall::read_ascending(path, "time_s,force_N");
  }
};

TEST_F(CsvTableFile, ReadsWhatSpreadsheetsWrite)
{
  const spall::ColumnPair columns =
      read("\xEF\xBB\xBF"
           "time_s, force_N\r\n0,10\n# middle\n\n1,30 \n3,-10\n\n");
  EXPECT_EQ(columns.first, (std::vector<double>{0., 1., 3.}));
  EXPECT_EQ(columns.second, (std::vector<double>{10., 30., -10.}));
}

TEST_F(CsvTableFile, RefusesInOneLineWithItsNumber)
{
  const std::string header = "time_s,force_N\n";
  const std::pair<std::string, std::string> wrong[] = {
      {"", "the first line must be time_s,force_N"},
      {header, "a row or more"},
      {"0,10\n1,30\n", ":1: \"0,10\": the header must be time_s,force_N"},
      {"force_N,time_s\n0,10\n", ":1: "},
      {header + "0,10\n1;30\n", ":3: \"1;30\": has 1 cells, must have 2"},
      {"time_s;force_N\n0;10\n", "time_s,force_N; commas separate cells"},
      {header + "0\t10\n", "time_s,force_N; commas separate cells"},
      {header + "0,10\n1,30,5\n", ":3: "},
      {header + "0,10\n1,30 kN\n", "numbers with decimal points"},
      {header + "0,10\n0,30\n", "must ascend from 0"},
      {header + "0.5,10\n", "must ascend from 0"},
      {header + "-1,0\n0,10\n", ":2: \"-1,0\""}};
  for (const auto &[text, word] : wrong)
    try
    {
      read(text);
      ADD_FAILURE() << text;
    }
    catch (const spall::InputError &fault)
    {
      const std::string said = fault.what();
      EXPECT_NE(said.find(path), std::string::npos) << said;
      EXPECT_NE(said.find(word), std::string::npos) << said;
      EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    }
}

TEST_F(CsvTableFile, IsNoFolderAndIsThere)
{
  EXPECT_THROW(spall::read_csv(testing::TempDir(), "x"), spall::InputError);
  EXPECT_THROW(spall::read_csv(path + ".none", "x"), spall::InputError);
}
} // namespace
