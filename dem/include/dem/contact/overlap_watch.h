#pragma once

#include <dem/contact/batch.h>

#include <cstdint>
#include <span>
#include <stdexcept>

namespace dem
{
/// Largest overlap over radius of all contacts in all steps [-].
struct OverlapRecord
{
  double recent = 0.;  ///< since the last row of the history
  double largest = 0.; ///< since the beginning

  void note(double ratio);
};

/// A contact is deeper than OverlapLimits::stop. The text names both bodies.
class OverlapStop : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// What the loop over contacts passes over: overlaps up to this are none that
/// the record does not contain [m].
struct OverlapScan
{
  const ContactBatch &batch;
  const ParticleSystem &particles;
  double known = 0.;
};

/// Overlap of contact k over the radius of the smaller equivalent sphere; what
/// a contact of true surfaces had when it was found counts too [-].
double overlap_ratio(const ContactBatch &batch, const ParticleSystem &particles,
                     std::size_t k);

/// Largest overlap_ratio() of the contacts [first, last) whose overlap exceeds
/// `scan.known`; 0: there is none.
double largest_overlap_ratio(const OverlapScan &scan, std::size_t first,
                             std::size_t last);
} // namespace dem
