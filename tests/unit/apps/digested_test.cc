#include "run/digested.h"
#include "test_folder.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace spall
{
namespace
{
namespace fs = std::filesystem;

// One bit anywhere, the digest included, or a byte less is seen.
TEST(Digested, DamageIsSeen)
{
  const fs::path file = support::test_folder() / "digested.bin";
  std::ostringstream written;
  write_digested(written, [](std::ostream &out)
                 { out << "state of a run" << '.' << 17; });
  const std::string bytes = written.str();
  EXPECT_EQ(bytes.substr(0, bytes.size() - 8), "state of a run.17");
  const auto is_taken = [&](const std::string &content)
  {
    std::ofstream(file, std::ios::binary) << content;
    return is_as_digested(file);
  };
  EXPECT_TRUE(is_taken(bytes));
  for (std::size_t k = 0; k < bytes.size(); ++k)
  {
    std::string damaged = bytes;
    damaged[k] ^= 0x40;
    EXPECT_FALSE(is_taken(damaged)) << k;
    EXPECT_FALSE(is_taken(bytes.substr(0, k))) << k;
  }
  fs::remove(file);
  EXPECT_FALSE(is_as_digested(file));
}
} // namespace
} // namespace spall
