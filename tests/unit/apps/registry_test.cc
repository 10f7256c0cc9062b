#include "case/fields.h"
#include "case/file.h"
#include "report/kind_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <stdexcept>

namespace
{
using namespace spall;

bool has_parameter(const std::string &kind, const std::string &name)
{
  Case defaults = default_case(kind);
  return std::ranges::any_of(
      parameters_of(defaults), [&](const Parameter &parameter)
      { return parameter.name() == name && parameter.is_of(kind); });
}
} // namespace

TEST(Registry, EveryEntryIsWhole)
{
  std::set<std::string> names;
  for (const TestKind &kind : test_kinds())
  {
    EXPECT_TRUE(names.insert(kind.name).second) << kind.name;
    EXPECT_EQ(find_kind(kind.name), &kind);
    EXPECT_TRUE(has_parameter(kind.name, kind.seed_key)) << kind.name;
    if (!kind.gradation_section.empty())
    {
      EXPECT_TRUE(
          has_parameter(kind.name, kind.gradation_section + "/gradation"))
          << kind.name;
    }
    for (const std::string &name : kind.may_change)
      EXPECT_TRUE(has_parameter(kind.name, name)) << name;
    EXPECT_FALSE(kind.report().headlines.empty()) << kind.name;
  }
}

TEST(Registry, SharedSectionsAreThere)
{
  Case any;
  any.walls.emplace_back().name = "floor";
  for (const TestKind &kind : test_kinds())
    for (const std::string &shared : kind.shared_sections)
      EXPECT_TRUE(std::ranges::any_of(sections(any),
                                      [&](const ListedSection &section)
                                      {
                                        return (section.name == shared ||
                                                section.name ==
                                                    shared + "/floor") &&
                                               section.is_of(kind.name) &&
                                               !section.kinds.empty();
                                      }))
          << kind.name << " " << shared;
}

TEST(Registry, ANameIsThereOnce)
{
  EXPECT_EQ(find_kind("no_such_kind"), nullptr);
  EXPECT_THROW(add_test_kind(test_kinds().front()), std::invalid_argument);
}
