#include "force_kernels.h"

#include <dem/contact/overlap_watch.h>

#include <algorithm>

namespace dem
{
namespace
{
/// Overlap of the two surfaces, of which a part may not count [m].
double depth(const ContactBatch &batch, std::size_t k)
{
  const double counted = batch.overlap[k];
  if (!batch.layout.has_contact_points ||
      batch.overlap_offset[k] >= kernel::closed_offset)
    return counted;
  return counted + batch.overlap_offset[k];
}
} // namespace

void OverlapRecord::note(double ratio)
{
  recent = std::max(recent, ratio);
  largest = std::max(largest, ratio);
}

double overlap_ratio(const ContactBatch &batch, const ParticleSystem &particles,
                     std::size_t k)
{
  double radius = particles.radius(static_cast<std::size_t>(batch.a[k]));
  if (batch.layout.has_partners)
    radius = std::min(radius,
                      particles.radius(static_cast<std::size_t>(batch.b[k])));
  return depth(batch, k) / radius;
}

double largest_overlap_ratio(const OverlapScan &scan, std::size_t first,
                             std::size_t last)
{
  const ContactBatch &batch = scan.batch;
  double largest = 0.;
  if (!batch.layout.has_contact_points)
  {
    // Nearly always the whole range is passed over.
    const double *overlap = batch.overlap.data();
    std::int64_t n_deeper = 0;
#pragma omp simd reduction(+ : n_deeper)
    for (std::size_t k = first; k < last; ++k)
      n_deeper += overlap[k] > scan.known ? 1 : 0;
    if (n_deeper == 0)
      return 0.;
  }
  for (std::size_t k = first; k < last; ++k)
    if (depth(batch, k) > scan.known)
      largest = std::max(largest, overlap_ratio(batch, scan.particles, k));
  return largest;
}
} // namespace dem
