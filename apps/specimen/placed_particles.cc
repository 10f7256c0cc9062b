#include "specimen/placed_particles.h"

#include "case/file.h"
#include "case/parameter.h"
#include "errors.h"
#include "shape/loaded.h"
#include "specimen/packing_file.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>

namespace spall
{
namespace
{
namespace fs = std::filesystem;

/// Shapes by the names of their files, each loaded when it is first needed.
class NamedShapes
{
public:
  NamedShapes(const Case &parameters, const PlacedSource &its_source,
              PlacedParticles &its_particles)
      : source(its_source), particles(its_particles)
  {
    if (!source.shapes.empty())
      for (const ShapeFile &file : read_shapes(
               find_path(parameters, source.section, "shapes", source.shapes)))
        files.emplace(fs::path(file.path).stem().string(), file);
  }

  /// A particle of the shape of this name. Throws InputError.
  dem::ParticleShape sized(const std::string &name, double radius,
                           const std::string &location)
  {
    if (name.empty() || name == "sphere")
      return dem::make_sphere(radius);
    const auto known = bodies.find(name);
    if (known != bodies.end())
      return dem::resized(known->second, radius);
    const auto file = files.find(name);
    if (file == files.end())
      refuse(name, location);
    particles.shapes.push_back(load_with_warnings(file->second, source.order));
    particles.shape_names.push_back(name);
    return bodies
        .emplace(name, dem::make_shape(particles.shapes.back(), radius))
        .first->second;
  }

private:
  [[noreturn]] void refuse(const std::string &name,
                           const std::string &location) const
  {
    std::vector<std::string> names = {"sphere"};
    for (const auto &[known, file] : files)
      names.push_back(known);
    const std::string near = nearest(name, names);
    throw InputError(location + ": shape " + name +
                     ": must be sphere or the name of a file in " +
                     source.section + "/shapes without its ending" +
                     (near.empty() ? "" : ", did you mean " + near + "?"));
  }

  const PlacedSource &source;
  PlacedParticles &particles;
  std::map<std::string, ShapeFile> files;
  std::map<std::string, dem::ParticleShape> bodies;
};

std::uint8_t material_of(const std::string &name, bool has_other_solid,
                         const std::string &location)
{
  if (name.empty() || name == "particle")
    return 0;
  if (name == "other" && has_other_solid)
    return 1;
  throw InputError(location + ": material " + name +
                   ": must be particle (section Particle)" +
                   (has_other_solid ? " or other (section Other, which does "
                                      "not break)"
                                    : ""));
}

/// The file, or that of the folder of a run.
std::string particle_file(const Case &parameters, const PlacedSource &source)
{
  const std::string path =
      find_path(parameters, source.section, "particles", source.particles);
  if (!fs::is_directory(path))
    return path;
  const fs::path last = fs::path(path) / "particles.csv";
  if (!fs::exists(last))
    throw InputError(parameters.file + ": " + source.section +
                     "/particles = " + path +
                     ": a folder must be that of a run that has ended, with "
                     "particles.csv");
  return last.string();
}

void write_row(std::ostream &out, const dem::ParticleSystem &all, std::size_t i)
{
  const dem::Vec3 &x = all.position(i), &v = all.velocity(i), &w = all.spin(i);
  const dem::Quaternion &q = all.orientation(i);
  for (const double number :
       {x.x(), x.y(), x.z(), all.radius(i), q.w(), q.x(), q.y(), q.z(), v.x(),
        v.y(), v.z(), w.x(), w.y(), w.z()})
    out << number_text(number) << ',';
}
} // namespace

PlacedParticles place_particles(const Case &parameters,
                                const PlacedSource &source)
{
  const Packing packing =
      read_placed_particles(particle_file(parameters, source));
  PlacedParticles placed;
  placed.box = packing.box;
  NamedShapes shapes(parameters, source, placed);
  const auto entry = [](const auto &column, std::size_t k, auto usual)
  { return column.empty() ? usual : column[k]; };
  const dem::Vec3 still = dem::Vec3::Zero();
  const dem::Quaternion unturned = dem::Quaternion::Identity();
  for (std::size_t k = 0; k < packing.size(); ++k)
  {
    const std::string &location = packing.location[k];
    const std::string shape = entry(packing.shape, k, std::string()),
                      material = entry(packing.material, k, std::string());
    placed.body.push_back(shapes.sized(shape, packing.radius[k], location));
    placed.placement.push_back(
        {packing.position[k], entry(packing.orientation, k, unturned)});
    placed.velocity.push_back(entry(packing.velocity, k, still));
    placed.spin.push_back(entry(packing.spin, k, still));
    placed.material.push_back(
        material_of(material, source.has_other_solid, location));
    placed.name.push_back(location);
  }
  return placed;
}

std::string particle_table(const dem::ParticleSystem &all,
                           const PlacedParticles &as_placed)
{
  std::ostringstream out;
  if (!std::ranges::all_of(all.shape,
                           [&](const dem::ParticleShape &shape)
                           {
                             return !shape.series ||
                                    std::ranges::find(as_placed.shapes,
                                                      shape.series) !=
                                        as_placed.shapes.end();
                           }))
    out << "# Particles that have broken have their first shapes here, with "
           "their present equivalent radii.\n";
  out << "x,y,z,radius,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz,shape,material\n";
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    const auto &series =
        as_placed.body[static_cast<std::size_t>(all.id[i])].series;
    const auto shape = static_cast<std::size_t>(
        std::ranges::find(as_placed.shapes, series) - as_placed.shapes.begin());
    write_row(out, all, i);
    out << (series ? as_placed.shape_names[shape] : "sphere") << ','
        << (all.material[i] == 0 ? "particle" : "other") << '\n';
  }
  return out.str();
}
} // namespace spall
