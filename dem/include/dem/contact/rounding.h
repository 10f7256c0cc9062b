#pragma once

/// Numbers that are rounded before they are added up, so that sums are exact
/// and do not depend on the order of their terms (docs/developer/parallel.md).
namespace dem
{
/// What is added to a number and taken away again to round it to a multiple of
/// the spacing u, a power of two: 1.5 * 2^52 u. Numbers below 2^51 u are
/// rounded to the nearest multiple.
constexpr double rounding_shift(double spacing)
{
  return 0x1.8p52 * spacing;
}

/// Losses of contacts in a step are added up in two parts, each rounded to a
/// multiple of its spacing: the sums of a range of contacts (8192 at most) are
/// exact [J].
inline constexpr double loss_spacing = 0x1p-30, loss_rest_spacing = 0x1p-70;
} // namespace dem
