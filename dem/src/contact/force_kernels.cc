// Compiled once per instruction set, with SPALL_INSTRUCTION_SET its name.
#include "law_loops.h"

#include <dem/contact/laws.h>

namespace dem::kernel
{
namespace
{
template <class Laws>
struct Table;
template <class... Law>
struct Table<std::tuple<Law...>>
{
  static constexpr Loops of_law[] = {loops_of<Law>()...};
};
} // namespace

namespace SPALL_INSTRUCTION_SET
{
extern const Loops *const contact_kernels;
const Loops *const contact_kernels = Table<ContactLaws>::of_law;
} // namespace SPALL_INSTRUCTION_SET
} // namespace dem::kernel
