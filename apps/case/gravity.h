#pragma once

namespace spall
{
inline constexpr double gravity = 9.81; ///< down, where a scene has it [m/s^2]
} // namespace spall
