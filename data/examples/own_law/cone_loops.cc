// Compiled once per instruction set.
#include "cone_law.h"

#include <contact/law_loops.h>

namespace SPALL_INSTRUCTION_SET
{
extern const dem::kernel::Loops cone_loops;
const dem::kernel::Loops cone_loops = dem::kernel::loops_of<Cone>();
} // namespace SPALL_INSTRUCTION_SET
