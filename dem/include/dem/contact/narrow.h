#pragma once

namespace dem
{
/// Of what contacts keep of their surfaces (contact point, gradient and second
/// derivatives of r; r itself is a double), of corners and of dashpots.
/// SPALL_WIDE_COLUMNS of CMake makes it a double: what floats cost and save is
/// in docs/developer/decisions/0005-contact-loops.md.
#ifdef SPALL_WIDE_COLUMNS
using Narrow = double;
#else
using Narrow = float;
#endif
} // namespace dem
