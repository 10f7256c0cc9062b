#include "run/overlap_news.h"

#include <dem/measure/totals.h>

#include <cstdio>

namespace spall
{
OverlapNews::OverlapNews(const dem::Engine &engine)
{
  const double largest = dem::total_overlaps(engine).largest;
  if (largest > engine.parameters().geometry.overlap.warning)
    reported = largest;
}

std::string OverlapNews::news(const dem::Engine &engine)
{
  constexpr double noticeable = 1.5; // [-]
  const dem::OverlapLimits &limits = engine.parameters().geometry.overlap;
  const double largest = dem::total_overlaps(engine).largest;
  if (largest <= limits.warning || largest <= noticeable * reported)
    return "";
  reported = largest;
  char text[200];
  std::snprintf(text, sizeof text,
                "warning: by %.6g s the largest overlap is %.3g of the radius "
                "of its particle (Contact/overlap_warning = %.3g, "
                "Contact/overlap_stop = %.3g)",
                engine.time(), largest, limits.warning, limits.stop);
  return text;
}
} // namespace spall
