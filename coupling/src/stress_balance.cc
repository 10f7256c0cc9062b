#include <coupling/stress_balance.h>
#include <dem/measure/region_stress.h>

namespace coupling
{
namespace
{
using dem::Mat3;
using dem::Vec3;

Mat3 moment(const Vec3 &force, const Vec3 &position)
{
  return force * position.transpose();
}

/// Tied nodes are held from outside, the others are accelerated.
void add_membrane_forces(const fem::Membrane &tube, const ConfiningLoad &load,
                         StressBalance &sums)
{
  for (std::size_t k = 0; k < tube.n_nodes(); ++k)
  {
    const auto node = static_cast<std::int32_t>(k);
    const Mat3 share =
        moment(tube.force(node), tube.positions()[k] - load.origin);
    (tube.is_tied(node) ? sums.boundary : sums.unrest) += share;
  }
  // Over a closed surface int n (x) x dA = V I; the lids are flat.
  sums.boundary += load.pressure * tube.enclosed_volume() * Mat3::Identity();
  sums.boundary(2, 2) -= load.pressure * load.plate_area * load.plate_height;
}
} // namespace

Mat3 membrane_stress(const EnclosedSpecimen &specimen)
{
  return specimen.membrane ? Mat3(-specimen.membrane->stress_integral() /
                                  enclosed_volume(specimen))
                           : Mat3(Mat3::Zero());
}

StressBalance stress_balance(const EnclosedSpecimen &specimen,
                             const ConfiningLoad &load)
{
  const dem::ParticleSystem &particles = specimen.engine.particles();
  const dem::Network network = dem::contact_network_of(specimen.engine);
  StressBalance sums;
  sums.particles = dem::contact_virial(particles, network);
  for (std::size_t k = 0; k < particles.size(); ++k)
    sums.unrest +=
        moment(particles.load[k].force, particles.position(k) - load.origin);
  for (const dem::WallContact &contact : network.walls)
    if (!contact.is_on_facets)
      sums.boundary -= moment(contact.force, contact.point - load.origin);
  // The forces across the faces of a periodic cell.
  const dem::PeriodicCell &cell = specimen.engine.cell();
  for (int d = 0; d < 3; ++d)
    if (cell.is_periodic(d))
      sums.boundary(d, d) -= cell.force[d] * cell.length[d];
  if (specimen.membrane)
    add_membrane_forces(*specimen.membrane, load, sums);
  const double volume = enclosed_volume(specimen);
  for (Mat3 *sum : {&sums.particles, &sums.boundary, &sums.unrest})
    *sum /= volume;
  sums.membrane = membrane_stress(specimen);
  return sums;
}
} // namespace coupling
