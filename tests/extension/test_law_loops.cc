// Compiled once per instruction set.
#include "test_laws.h"

#include <contact/law_loops.h>

namespace SPALL_INSTRUCTION_SET
{
extern const dem::kernel::Loops reordered_loops, pulling_loops;
const dem::kernel::Loops reordered_loops = dem::kernel::loops_of<Reordered>();
const dem::kernel::Loops pulling_loops = dem::kernel::loops_of<Pulling>();
} // namespace SPALL_INSTRUCTION_SET
