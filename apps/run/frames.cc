#include "run/frames.h"

#include "case/data_folders.h"
#include "run/first_rank.h"
#include "run/whole_file.h"

#include <dem/engine_boundaries.h>
#include <dem/measure/assembly.h>
#include <dem/measure/network.h>

#include <cstdio>
#include <fstream>
#include <span>
#include <sstream>
#include <string>
#include <system_error>

namespace spall
{
namespace
{
std::vector<dem::ContactLine> contact_lines(const dem::Engine &engine)
{
  std::vector<dem::ContactLine> lines;
  const auto add = [&](const dem::ContactBatch &batch, dem::ContactKind kind)
  {
    for (std::size_t k = 0; k < batch.size(); ++k)
    {
      if (!batch.is_touching(k))
        continue;
      const auto a = static_cast<std::size_t>(batch.a[k]);
      const dem::Vec3 &from = engine.particles().position(a);
      const dem::Vec3 to =
          kind == dem::ContactKind::particle_particle
              ? dem::Vec3(from + engine.particles().branch(
                                     a, static_cast<std::size_t>(batch.b[k])))
              : dem::wall_contact_point(engine, batch, k);
      const dem::Vec3 n = (to - from).normalized();
      const dem::Vec3 force =
          kind == dem::ContactKind::particle_particle
              ? dem::pair_force(engine.particles(), batch, k)
              : batch.load[k].force;
      lines.push_back({from, to, -force.dot(n),
                       (force - force.dot(n) * n).norm(), batch.overlap[k],
                       kind});
    }
  };
  add(engine.pairs(), dem::ContactKind::particle_particle);
  add(dem::on_planes(engine), dem::ContactKind::particle_plane);
  add(dem::on_drum(engine), dem::ContactKind::particle_plane);
  for (const dem::FacetBoundary &facets : dem::all_facets(engine))
    add(facets.batch, dem::ContactKind::particle_facet);
  return lines;
}

void copy_view(const std::filesystem::path &folder)
{
  for (const std::filesystem::path &data : data_folders())
  {
    const std::filesystem::path script = data / "paraview" / "view.py";
    std::ifstream in(script, std::ios::binary);
    std::ostringstream text;
    if (in && text << in.rdbuf()) // frames are worth having without it
      return write_text(folder / "view.py", text.str(), Durability::usual);
  }
}
/// Numbers of the parts in the collection of frames.
enum : int
{
  particles_part,
  contacts_part,
  membrane_part,
  surfaces_part,
  first_body_part,
  walls_part = 100
};

/// The particles that an engine owns, as columns of a frame.
class OwnedParticles
{
public:
  explicit OwnedParticles(const dem::ParticleSystem &particles)
      : system(particles), n(particles.n_owned()),
        position(particles.column(&dem::ParticleState::position)),
        velocity(particles.column(&dem::ParticleState::velocity)),
        spin(particles.column(&dem::ParticleState::spin)),
        orientation(particles.column(&dem::ParticleState::orientation)),
        radius(particles.column(&dem::ParticleState::radius)), mass(n), loss(n)
  {
    for (std::size_t i = 0; i < n; ++i)
    {
      mass[i] = particles.solid_mass(i);
      loss[i] = 1. - mass[i] / particles.initial_mass[i];
    }
  }

  dem::ParticleColumns columns() const
  {
    const auto first = [this](const auto &column)
    { return std::span(column).first(n); };
    return {first(system.id),
            first(position),
            first(velocity),
            first(spin),
            first(orientation),
            first(system.shape),
            first(radius),
            mass,
            loss};
  }

private:
  const dem::ParticleSystem &system;
  std::size_t n;
  std::vector<dem::Vec3> position, velocity, spin;
  std::vector<dem::Quaternion> orientation;
  std::vector<double> radius, mass, loss;
};

/// A part of a frame that can be written in pieces.
struct SharedPart
{
  int part;
  const char *name;
  dem::FramePart index;
  std::function<void(std::ostream &)> write;
};

std::vector<SharedPart> shared_parts(const dem::Engine &engine,
                                     const OwnedParticles &particles,
                                     bool has_surfaces)
{
  std::vector<SharedPart> all = {
      {particles_part, "particles", dem::FramePart::particles,
       [&](std::ostream &out)
       { dem::write_particles(out, particles.columns()); }},
      {contacts_part, "contacts", dem::FramePart::contacts,
       [&](std::ostream &out)
       { dem::write_contacts(out, contact_lines(engine)); }}};
  if (has_surfaces)
    all.push_back({surfaces_part, "surfaces", dem::FramePart::surfaces,
                   [&](std::ostream &out)
                   { dem::write_surfaces(out, particles.columns()); }});
  return all;
}

/// NAME_NNNNN
std::string stem_of(const char *name, int number)
{
  char text[64];
  std::snprintf(text, sizeof text, "%s_%05d", name, number);
  return text;
}

/// NAME_NNNNN_RRRR.vtu
std::string piece_of(const std::string &stem, int rank)
{
  char text[16];
  std::snprintf(text, sizeof text, "_%04d.vtu", rank);
  return stem + text;
}

/// The files of one frame, as they come to be.
class FrameFiles
{
public:
  FrameFiles(const std::filesystem::path &in, double at, int frame,
             std::vector<dem::FrameEntry> &all)
      : folder(in), time(at), number(frame), entries(all)
  {
    if (entries.empty())
      copy_view(folder);
  }

  void add(int part, const char *name,
           const std::function<void(std::ostream &)> &write,
           const char *ending = ".vtu")
  {
    const std::string file = "frames/" + stem_of(name, number) + ending;
    write_whole(folder / file, write);
    entries.push_back({time, part, file});
  }

  /// A part in one file.
  void add_whole(const SharedPart &of)
  {
    add(of.part, of.name, of.write);
    remove_older(of, ".pvtu", 0);
  }

  void add_index(const SharedPart &of, int n_pieces)
  {
    std::vector<std::string> pieces;
    for (int rank = 0; rank < n_pieces; ++rank)
      pieces.push_back(piece_of(stem_of(of.name, number), rank));
    add(
        of.part, of.name,
        [&](std::ostream &out)
        { dem::write_piece_index(out, of.index, pieces); },
        ".pvtu");
    remove_older(of, ".vtu", n_pieces);
  }

  /// What stands on every rank, and run.pvd.
  void add_rest(const dem::Engine &engine, const FrameParts &parts)
  {
    if (parts.membrane)
      add(membrane_part, "membrane",
          [&](std::ostream &out) { parts.membrane->write_vtu(out); });
    if (const auto walls = dem::mesh_walls(engine); !walls.empty())
      add(walls_part, "walls",
          [&](std::ostream &out)
          {
            std::vector<const dem::FacetSurface *> surfaces;
            for (const dem::MeshWall &wall : walls)
              surfaces.push_back(&wall.surface);
            dem::write_facets(out, surfaces);
          });
    int part = first_body_part;
    for (const FrameBody &body : parts.bodies)
      add(part++, body.name, body.write);
    write_text(folder / "run.pvd", dem::collection_text(entries),
               Durability::usual);
  }

private:
  /// What a run that went farther on another number of ranks has left.
  void remove_older(const SharedPart &of, const char *ending, int first_piece)
  {
    const std::string stem = stem_of(of.name, number);
    const auto remove = [this](const std::string &name)
    {
      std::error_code status;
      return std::filesystem::remove(folder / "frames" / name, status);
    };
    remove(stem + ending);
    for (int rank = first_piece; remove(piece_of(stem, rank));)
      ++rank;
  }

  const std::filesystem::path &folder;
  double time;
  int number;
  std::vector<dem::FrameEntry> &entries;
};
} // namespace

void write_frame(const std::filesystem::path &folder, const dem::Engine &engine,
                 const FrameParts &parts, int number,
                 std::vector<dem::FrameEntry> &entries)
{
  const OwnedParticles particles(engine.particles());
  FrameFiles files(folder, engine.time(), number, entries);
  for (const SharedPart &one :
       shared_parts(engine, particles, parts.has_surfaces))
    files.add_whole(one);
  files.add_rest(engine, parts);
}

void write_frame_in_pieces(const std::filesystem::path &folder,
                           const dem::Engine &engine, const FrameParts &parts,
                           int number, std::vector<dem::FrameEntry> &entries)
{
  const dem::Ranks &ranks = engine.distribution().ranks();
  const OwnedParticles particles(engine.particles());
  const std::vector<SharedPart> shared =
      shared_parts(engine, particles, parts.has_surfaces);
  on_every_rank(ranks,
                [&]
                {
                  for (const SharedPart &one : shared)
                    write_whole(
                        folder / "frames" /
                            piece_of(stem_of(one.name, number), ranks.rank()),
                        one.write);
                });
  on_first_rank(ranks,
                [&]
                {
                  FrameFiles files(folder, engine.time(), number, entries);
                  for (const SharedPart &one : shared)
                    files.add_index(one, ranks.size());
                  files.add_rest(engine, parts);
                });
}

std::vector<dem::FrameEntry>
present_frames(const std::filesystem::path &folder,
               std::vector<dem::FrameEntry> entries)
{
  std::erase_if(entries, [&](const dem::FrameEntry &entry)
                { return !std::filesystem::exists(folder / entry.file); });
  return entries;
}
} // namespace spall
