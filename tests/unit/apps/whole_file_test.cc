#include "errors.h"
#include "run/csv_file.h"
#include "run/scratch_folder.h"
#include "run/whole_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace spall
{
namespace
{
namespace fs = std::filesystem;

std::string text_of(const fs::path &path)
{
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/// The message of what `call` throws.
template <class Exception, class Call>
std::string thrown(const Call &call)
{
  try
  {
    call();
  }
  catch (const Exception &error)
  {
    return error.what();
  }
  return "";
}

// Sizes below, at and above that of the buffer.
TEST(WholeFile, HoldsEveryByte)
{
  const ScratchFolder folder;
  const fs::path path = folder.path() / "file";
  for (const std::size_t n : {0, 1, 32767, 32768, 32769, 100000})
  {
    std::string expected;
    write_whole(
        path,
        [&](std::ostream &out)
        {
          for (std::size_t k = 0; k < n; k += 7)
          {
            const std::string part(std::min<std::size_t>(7, n - k),
                                   static_cast<char>('a' + k % 26));
            expected += part;
            out << part;
          }
          out.put('!');
          expected += '!';
          const std::string whole(n, 'z');
          out << whole;
          expected += whole;
        },
        Durability::on_disk);
    EXPECT_EQ(text_of(path), expected) << n;
    EXPECT_FALSE(fs::exists(path.string() + ".part"));
  }
}

TEST(WholeFile, AFaultLeavesTheEarlierFile)
{
  const ScratchFolder folder;
  const fs::path path = folder.path() / "file";
  write_text(path, "before");
  EXPECT_THROW(write_whole(path,
                           [](std::ostream &out)
                           {
                             out << "half of the";
                             throw std::runtime_error("fault");
                           }),
               std::runtime_error);
  EXPECT_NE(thrown<RunFailure>(
                [&]
                {
                  write_whole(path, [](std::ostream &out)
                              { out.setstate(std::ios::badbit); });
                })
                .find(path.string() + ": cannot be written: "),
            std::string::npos);
  EXPECT_EQ(text_of(path), "before");
  EXPECT_FALSE(fs::exists(path.string() + ".part"));
}

TEST(WholeFile, ErrorsOfTheSystemAreNamed)
{
  const ScratchFolder folder;
  EXPECT_EQ(thrown<RunFailure>([] { write_text("/dev/full", "text"); }),
            "/dev/full: cannot be written: No space left on device");
  EXPECT_EQ(thrown<RunFailure>([] { write_asked("/dev/full", "text"); }),
            "/dev/full: cannot be written: No space left on device");
  const std::string nowhere = folder.path() / "nowhere" / "file";
  EXPECT_EQ(thrown<InputError>([&] { write_asked(nowhere, "text"); }),
            nowhere + ": cannot be written: No such file or directory");
  EXPECT_EQ(thrown<RunFailure>([&] { write_text(folder.path(), "text"); }),
            folder.path().string() + ": cannot be written: Is a directory");
}

TEST(WholeFile, OfALinkTheFileBehindItIsWritten)
{
  const ScratchFolder folder;
  const fs::path file = folder.path() / "file", link = folder.path() / "link";
  write_text(file, "before");
  fs::create_symlink(file, link);
  write_text(link, "after");
  EXPECT_EQ(text_of(file), "after");
  EXPECT_TRUE(fs::is_symlink(link));
}

TEST(CsvFile, GoesBackToTheRowsOfACheckpoint)
{
  const ScratchFolder folder;
  const fs::path path = folder.path() / "table.csv";
  CsvFile table;
  table.open(path, "a_1,b_1");
  table.write_row({1., 0.1});
  const std::uint64_t size = table.flushed_size();
  EXPECT_EQ(size, fs::file_size(path));
  table.write_row({2., 1e-300}); // not yet in the file
  table.resume(path, size);
  table.write_row({3., -0.25});
  const std::uint64_t flushed = table.flushed_size();
  EXPECT_EQ(flushed, fs::file_size(path));
  EXPECT_EQ(text_of(path), "a_1,b_1\n1,0.1\n3,-0.25\n");
  EXPECT_THROW(table.resume(path, 1000), InputError);
  EXPECT_THROW(table.resume(folder.path() / "none.csv", 0), InputError);
}

TEST(CsvFile, AFullDiskIsNamed)
{
  CsvFile table;
  table.open("/dev/full", "a_1");
  EXPECT_EQ(thrown<RunFailure>([&] { table.flushed_size(); }),
            "/dev/full: cannot be written: No space left on device");
}
} // namespace
} // namespace spall
