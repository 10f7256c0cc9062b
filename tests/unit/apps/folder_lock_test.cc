#include "errors.h"
#include "run/folder_lock.h"
#include "test_folder.h"

#include <gtest/gtest.h>

#include <optional>

using namespace spall;

TEST(FolderLock, OneRunHasAFolderUntilItEnds)
{
  const std::filesystem::path folder = support::test_folder();
  std::optional<FolderLock> first(folder);
  EXPECT_THROW(FolderLock second(folder), InputError);
  first.reset();
  EXPECT_NO_THROW(FolderLock second(folder));
}

TEST(FolderLock, FolderThatIsNotThereIsNoFault)
{
  EXPECT_NO_THROW(FolderLock(support::test_folder() / "none"));
}
