// The kinds of tests that the program has.
#include "compaction/kind.h"
#include "los_angeles/kind.h"
#include "scene/kind.h"
#include "single_particle/kind.h"
#include "subgrade/kind.h"
#include "triaxial/kind.h"

#include <algorithm>
#include <stdexcept>

namespace spall
{
namespace
{
std::vector<TestKind> &registry()
{
  static std::vector<TestKind> kinds = {
      triaxial_kind(),   single_particle_kind(), los_angeles_kind(),
      compaction_kind(), subgrade_kind(),        scene_kind()};
  return kinds;
}
} // namespace

const std::vector<TestKind> &test_kinds()
{
  return registry();
}

void add_test_kind(TestKind kind)
{
  if (find_kind(kind.name))
    throw std::invalid_argument("there is a kind of test with the name " +
                                kind.name);
  registry().push_back(std::move(kind));
}

const TestKind *find_kind(const std::string &name)
{
  const auto found = std::ranges::find(registry(), name, &TestKind::name);
  return found == registry().end() ? nullptr : &*found;
}

std::vector<std::string> kind_names()
{
  std::vector<std::string> names;
  for (const TestKind &kind : registry())
    names.push_back(kind.name);
  return names;
}
} // namespace spall
