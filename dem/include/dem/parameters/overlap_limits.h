#pragma once

namespace dem
{
/// Limits of the overlap of a contact over the radius of the equivalent sphere
/// of its particle, of two particles the smaller one [-]
/// (docs/theory/contact_geometry.md, "Overlap and radius").
struct OverlapLimits
{
  double warning = 0.05; ///< Hertz theory no longer holds above it
  double stop = 0.5;     ///< the engine stops above it; of centres that meet: 2
};
} // namespace dem
