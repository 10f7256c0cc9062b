#include "run/frames.h"

#include "case/data_folders.h"
#include "run/whole_file.h"

#include <dem/engine_boundaries.h>
#include <dem/measure/assembly.h>
#include <dem/measure/network.h>

#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>

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

/// Number of the mesh walls in the collection of frames.
constexpr int walls_part = 100;

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
} // namespace

void write_frame(const std::filesystem::path &folder, const dem::Engine &engine,
                 const FrameParts &parts, int number,
                 std::vector<dem::FrameEntry> &entries)
{
  if (entries.empty())
    copy_view(folder);
  const dem::ParticleSystem &particles = engine.particles();
  std::vector<double> mass(particles.size()), loss(particles.size());
  for (std::size_t i = 0; i < loss.size(); ++i)
  {
    mass[i] = particles.solid_mass(i);
    loss[i] = 1. - mass[i] / particles.initial_mass[i];
  }
  using dem::ParticleState;
  const auto position = particles.column(&ParticleState::position),
             velocity = particles.column(&ParticleState::velocity),
             spin = particles.column(&ParticleState::spin);
  const auto orientation = particles.column(&ParticleState::orientation);
  const auto radius = particles.column(&ParticleState::radius);
  const dem::ParticleColumns columns{particles.id, position,    velocity,
                                     spin,         orientation, particles.shape,
                                     radius,       mass,        loss};
  using Out = std::ostream &;
  const auto add =
      [&](int part, const char *label, const std::function<void(Out)> &write)
  {
    char name[64];
    std::snprintf(name, sizeof name, "frames/%s_%05d.vtu", label, number);
    write_whole(folder / name, write);
    entries.push_back({engine.time(), part, name});
  };
  add(0, "particles", [&](Out out) { dem::write_particles(out, columns); });
  add(1, "contacts",
      [&](Out out) { dem::write_contacts(out, contact_lines(engine)); });
  if (parts.membrane)
    add(2, "membrane", [&](Out out) { parts.membrane->write_vtu(out); });
  if (const auto walls = dem::mesh_walls(engine); !walls.empty())
    add(walls_part, "walls",
        [&](Out out)
        {
          std::vector<const dem::FacetSurface *> surfaces;
          for (const dem::MeshWall &wall : walls)
            surfaces.push_back(&wall.surface);
          dem::write_facets(out, surfaces);
        });
  if (parts.has_surfaces)
    add(3, "surfaces", [&](Out out) { dem::write_surfaces(out, columns); });
  int part = 4;
  for (const FrameBody &body : parts.bodies)
    add(part++, body.name, body.write);
  write_text(folder / "run.pvd", dem::collection_text(entries),
             Durability::usual);
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
