#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace dem
{
/// Sum of doubles that does not depend on the order of its terms. It is an
/// integer of 128 bits that counts units of 2^-80: every term is rounded to the
/// nearest unit (half to even), and the sum of the rounded terms is exact. One
/// term changes by 2^-81 = 4.1e-25 at most, and none that is a multiple of
/// 2^-80, such as every double of at least 2^-28 = 3.7e-9.
class ExactSum
{
public:
  /// Terms and sums are smaller than 2^47 = 1.4e14 in magnitude. Throws
  /// std::overflow_error where they are not and leaves the sum as it was.
  void add(double term);
  ExactSum &operator+=(const ExactSum &other);

  double value() const; ///< the double nearest to the sum, half to even

  /// The sum in four pieces of 32 bits, the lowest one first. Only the last one
  /// has a sign. Entry-wise sums of up to 2^30 rows of pieces are the pieces of
  /// the sum, for from_limbs().
  std::array<std::int64_t, 4> limbs() const;
  /// Throws std::overflow_error where the sum is out of range.
  static ExactSum from_limbs(const std::array<std::int64_t, 4> &limbs);

  bool operator==(const ExactSum &) const = default;

private:
  __extension__ typedef __int128 Integer;

  /// The largest shift of 53 bits that leaves the sign of an Integer alone.
  static constexpr int largest_shift = 74;
  static Integer units_of(std::uint64_t mantissa, int shift);
  [[noreturn]] static void refuse(double term);
  [[noreturn]] static void refuse_sum();

  Integer sum = 0; ///< in units of 2^-80
};

/// mantissa * 2^shift, rounded to the nearest integer, half to even.
inline ExactSum::Integer ExactSum::units_of(std::uint64_t mantissa, int shift)
{
  if (shift >= 0)
    return static_cast<Integer>(mantissa) << shift;
  if (shift < -53) // less than half a unit
    return 0;
  const std::uint64_t half = std::uint64_t{1} << (-shift - 1);
  const std::uint64_t is_odd = (mantissa >> -shift) & 1;
  return static_cast<Integer>((mantissa + half - 1 + is_odd) >> -shift);
}

inline void ExactSum::add(double term)
{
  constexpr std::uint64_t leading = std::uint64_t{1} << 52;
  const auto bits = std::bit_cast<std::uint64_t>(term);
  // |term| = mantissa * 2^(exponent - 1075). Denormal numbers have no leading
  // bit, but are zero here with one as well.
  const int exponent = static_cast<int>(bits >> 52 & 0x7ff);
  const std::uint64_t mantissa = (bits & (leading - 1)) | leading;
  const int shift = exponent - 1075 + 80;
  if (shift > largest_shift) // not finite ones included
    refuse(term);
  // Without a branch, which random signs would mislead.
  const Integer sign = -static_cast<Integer>(bits >> 63); // 0 or -1
  const Integer units = (units_of(mantissa, shift) ^ sign) - sign;
  Integer next = 0;
  if (__builtin_add_overflow(sum, units, &next))
    refuse_sum();
  sum = next;
}
} // namespace dem
