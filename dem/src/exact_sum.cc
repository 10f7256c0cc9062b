#include <dem/exact_sum.h>

#include <cstddef>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace dem
{
namespace
{
constexpr int limb_bits = 32;
constexpr std::int64_t limb_mask = 0xffffffff;
} // namespace

ExactSum &ExactSum::operator+=(const ExactSum &other)
{
  Integer next = 0;
  if (__builtin_add_overflow(sum, other.sum, &next))
    refuse_sum();
  sum = next;
  return *this;
}

// The conversion rounds to nearest, half to even; the product is exact.
double ExactSum::value() const
{
  return static_cast<double>(sum) * 0x1p-80;
}

std::array<std::int64_t, 4> ExactSum::limbs() const
{
  std::array<std::int64_t, 4> limbs{};
  for (std::size_t k = 0; k < 3; ++k)
    limbs[k] =
        static_cast<std::int64_t>(sum >> (limb_bits * static_cast<int>(k))) &
        limb_mask;
  limbs[3] = static_cast<std::int64_t>(sum >> (3 * limb_bits));
  return limbs;
}

ExactSum ExactSum::from_limbs(const std::array<std::int64_t, 4> &limbs)
{
  ExactSum result;
  std::int64_t carry = 0;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const std::int64_t entry = limbs[k] + carry;
    result.sum += static_cast<Integer>(entry & limb_mask)
                  << (limb_bits * static_cast<int>(k));
    carry = entry >> limb_bits;
  }
  const std::int64_t top = limbs[3] + carry;
  if (top < std::numeric_limits<std::int32_t>::min() ||
      top > std::numeric_limits<std::int32_t>::max())
    refuse_sum();
  result.sum += static_cast<Integer>(top) << (3 * limb_bits);
  return result;
}

void ExactSum::refuse(double term)
{
  std::ostringstream message;
  message << "term of an exact sum: " << term
          << ": must be finite and smaller than 2^47 = 1.4e14 in magnitude";
  throw std::overflow_error(message.str());
}

void ExactSum::refuse_sum()
{
  throw std::overflow_error(
      "exact sum: must be smaller than 2^47 = 1.4e14 in magnitude");
}
} // namespace dem
