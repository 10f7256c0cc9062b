#pragma once

namespace dem
{
/// What the contact loops are compiled for. Every one gives the same digits.
enum class InstructionSet
{
  baseline, ///< x86-64: SSE2, 2 numbers at once
  avx2,     ///< AVX2, 4 numbers
  avx512    ///< AVX-512 F, DQ, BW, VL, 8 numbers
};

/// The widest that this processor has.
InstructionSet widest_instruction_set();

/// What the loops use: at first the widest.
InstructionSet instruction_set();

/// For measurements and tests; not while forces are being computed. Throws
/// std::invalid_argument if the processor does not have it.
void use_instruction_set(InstructionSet set);

const char *name_of(InstructionSet set);
} // namespace dem
