#include "triaxial/stress_balance.h"

#include "triaxial/triaxial.h"

#include <dem/measure/region_stress.h>

namespace spall
{
namespace
{
using dem::Mat3;
using dem::Vec3;

Mat3 moment(const Vec3 &force, const Vec3 &position)
{
  return force * position.transpose();
}
} // namespace

/// Of the sheet, compression positive [Pa].
dem::Mat3 Triaxial::membrane_stress() const
{
  return membrane() ? Mat3(-membrane()->stress_integral() / volume())
                    : Mat3(Mat3::Zero());
}

/// Tied nodes are held from outside, the others are accelerated.
void Triaxial::add_membrane_forces(StressBalance &sums, const Vec3 &from) const
{
  const fem::Membrane &tube = *membrane();
  for (std::size_t k = 0; k < tube.n_nodes(); ++k)
  {
    const auto node = static_cast<std::int32_t>(k);
    const Mat3 share = moment(tube.force(node), tube.positions()[k] - from);
    (tube.is_tied(node) ? sums.boundary : sums.unrest) += share;
  }
  // Over a closed surface int n (x) x dA = V I; the lids are flat.
  sums.boundary += pressure * volume() * Mat3::Identity();
  sums.boundary(2, 2) -= pressure * area * (cell->plate().height() - lower.z());
}

StressBalance Triaxial::stress_balance() const
{
  const dem::ParticleSystem &particles = engine().particles();
  const dem::Network network = dem::contact_network_of(engine());
  const Vec3 from = 0.5 * (lower + Vec3(upper.x(), upper.y(), lower.z()));
  StressBalance sums;
  sums.particles = dem::contact_virial(particles, network);
  for (std::size_t k = 0; k < particles.size(); ++k)
    sums.unrest +=
        moment(particles.load[k].force, particles.position(k) - from);
  for (const dem::WallContact &contact : network.walls)
    if (!contact.is_on_facets)
      sums.boundary -= moment(contact.force, contact.point - from);
  if (membrane())
    add_membrane_forces(sums, from);
  for (Mat3 *sum : {&sums.particles, &sums.boundary, &sums.unrest})
    *sum /= volume();
  sums.membrane = membrane_stress();
  return sums;
}
} // namespace spall
