#pragma once

#include <dem/particles.h>
#include <dem/search/spots.h>

#include <map>
#include <memory>
#include <vector>

namespace dem
{
/// The radius map of every stone; stones of one shape share one.
class StoneMaps
{
public:
  /// Makes the maps of shapes that are new.
  void update(const Particles &particles);

  MappedStone stone(const Particles &particles, std::size_t i) const
  {
    return {particles.body[i], *map_of[i]};
  }

private:
  using Map = std::shared_ptr<const RadiusMap>;

  std::vector<Map> map_of;
  std::map<const Coefficients *, Map> known; ///< by series
};
} // namespace dem
