#pragma once

#include <cstddef>
#include <cstdint>

namespace dem
{
/// The row of a particle, as an index of its columns.
inline std::size_t row_of(std::int32_t particle)
{
  return static_cast<std::size_t>(particle);
}
} // namespace dem
