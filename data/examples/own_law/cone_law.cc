#include "cone_law.h"

#include <dem/contact/law_table.h>

namespace baseline
{
extern const dem::kernel::Loops cone_loops;
}
namespace avx2
{
extern const dem::kernel::Loops cone_loops;
}
namespace avx512
{
extern const dem::kernel::Loops cone_loops;
}

void add_cone_law()
{
  dem::add_contact_law(dem::contact_law_entry<Cone>(
      dem::loops_by_instruction_set<baseline::cone_loops, avx2::cone_loops,
                                    avx512::cone_loops>));
}
