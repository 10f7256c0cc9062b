#pragma once

#include <dem/boundary/drum.h>
#include <dem/boundary/facet_surface.h>
#include <dem/shape/particle_shape.h>

#include <cstdint>
#include <iosfwd>
#include <span>
#include <string>
#include <vector>

namespace dem
{
/// Columns of the particles at one instant; entry k of each is one particle.
struct ParticleColumns
{
  std::span<const std::int64_t> id;
  std::span<const Vec3> position;          ///< [m]
  std::span<const Vec3> velocity;          ///< [m/s]
  std::span<const Vec3> spin;              ///< world frame [rad/s]
  std::span<const Quaternion> orientation; ///< body to world
  std::span<const ParticleShape> body;
  std::span<const double> radius; ///< of the equivalent sphere [m]
  std::span<const double> mass;   ///< [kg]
  std::span<const double> loss;   ///< mass lost / initial mass [-]
};

enum class ContactKind : std::int32_t
{
  particle_particle,
  particle_plane,
  particle_facet
};

/// One touching contact as a line.
struct ContactLine
{
  Vec3 from = Vec3::Zero(),
       to = Vec3::Zero();   ///< centre to centre or to wall [m]
  double normal_force = 0.; ///< [N]
  double shear_force = 0.;  ///< [N]
  double overlap = 0.;      ///< [m]
  ContactKind kind = ContactKind::particle_particle;
};

/// One file of the collection.
struct FrameEntry
{
  double time = 0.; ///< [s]
  int part = 0;     ///< 0 particles, 1 contacts, 2 membrane, 3 surfaces
  std::string file; ///< relative to the .pvd
};

/// Particles as points with all fields (vtu). Throws std::runtime_error if VTK
/// fails, as do the other writers; the caller checks the stream.
void write_particles(std::ostream &out, const ParticleColumns &particles);

/// True surfaces of the particles (vtu): each the image of one triangulated
/// sphere (about 1300 triangles a particle), with id and loss per cell.
void write_surfaces(std::ostream &out, const ParticleColumns &particles);

/// Contacts as lines with their forces (vtu).
void write_contacts(std::ostream &out, std::span<const ContactLine> contacts);

/// What each rank may write of its own particles and contacts.
enum class FramePart
{
  particles,
  contacts,
  surfaces
};

/// Index (pvtu) of a part that ranks have written in pieces, files of the
/// writers above; their names are relative to that of the index.
void write_piece_index(std::ostream &out, FramePart part,
                       std::span<const std::string> pieces);

/// The triangles of surfaces with the number of the surface, `wall`, and at the
/// vertices the force of the particles and the velocity (vtu).
void write_facets(std::ostream &out,
                  std::span<const FacetSurface *const> surfaces);

/// Side and lifter of a drum as it stands, open at both ends (vtu).
void write_drum(std::ostream &stream, const Drum &drum);

/// ParaView collection (pvd) over all frames so far.
std::string collection_text(std::span<const FrameEntry> entries);
} // namespace dem
