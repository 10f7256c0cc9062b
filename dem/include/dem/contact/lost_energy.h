#pragma once

#include <dem/contact/spring.h>
#include <dem/exact_sum.h>

namespace dem
{
/// Losses of any number of contacts and steps: the same sum in whatever order
/// they are added.
struct LostEnergy
{
  ExactSum friction, rolling, damping, non_conservative_work;

  LostEnergy &operator+=(const Dissipation &part)
  {
    friction.add(part.friction);
    rolling.add(part.rolling);
    damping.add(part.damping);
    non_conservative_work.add(part.non_conservative_work);
    return *this;
  }
  LostEnergy &operator+=(const LostEnergy &part)
  {
    friction += part.friction;
    rolling += part.rolling;
    damping += part.damping;
    non_conservative_work += part.non_conservative_work;
    return *this;
  }
  Dissipation value() const
  {
    return {friction.value(), rolling.value(), damping.value(),
            non_conservative_work.value()};
  }
};
} // namespace dem
