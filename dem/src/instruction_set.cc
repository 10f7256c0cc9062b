#include <dem/instruction_set.h>

#include <stdexcept>
#include <string>

namespace dem
{
namespace
{
InstructionSet chosen = widest_instruction_set();
} // namespace

InstructionSet widest_instruction_set()
{
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"))
    return InstructionSet::avx512;
  return __builtin_cpu_supports("avx2") ? InstructionSet::avx2
                                        : InstructionSet::baseline;
}

InstructionSet instruction_set()
{
  return chosen;
}

void use_instruction_set(InstructionSet set)
{
  if (set > widest_instruction_set())
    throw std::invalid_argument(std::string("this processor has no ") +
                                name_of(set) + ": at most " +
                                name_of(widest_instruction_set()));
  chosen = set;
}

const char *name_of(InstructionSet set)
{
  return set == InstructionSet::avx512 ? "AVX-512"
         : set == InstructionSet::avx2 ? "AVX2"
                                       : "SSE2";
}
} // namespace dem
