#include "specimen/placed_particles.h"

#include "case/file.h"
#include "case/parameter.h"
#include "errors.h"
#include "shape/loaded.h"
#include "specimen/packing_file.h"

#include <dem/shape/quadrature.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>

namespace spall
{
namespace
{
namespace fs = std::filesystem;

/// The file of particles, and of a run the folder of its shapes.
struct ParticleFiles
{
  fs::path particles, shapes;
};

ParticleFiles particle_files(const Case &parameters, const PlacedSource &source)
{
  const fs::path path =
      find_path(parameters, source.section, "particles", source.particles);
  if (!fs::is_directory(path))
    return {path, {}};
  const fs::path last = path / "particles.csv";
  if (!fs::exists(last))
    throw InputError(parameters.file + ": " + source.section +
                     "/particles = " + path.string() +
                     ": a folder must be that of a run that has ended, with "
                     "particles.csv");
  return {last, path / "shapes"};
}

/// Shapes by the names of their files, each loaded when it is first needed.
class NamedShapes
{
public:
  /// `of_run`: folder of the shapes that a run has written, or none.
  NamedShapes(const Case &its_case, const PlacedSource &its_source,
              const fs::path &of_run, PlacedParticles &its_particles)
      : parameters(its_case), source(its_source), particles(its_particles)
  {
    if (!source.shapes.empty())
      note_files(find_path(parameters, source.section, "shapes", source.shapes),
                 given);
    note_files(of_run, last);
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
    return bodies.emplace(name, made(name, radius, location)).first->second;
  }

private:
  static void note_files(const fs::path &folder,
                         std::map<std::string, fs::path> &files)
  {
    if (fs::is_directory(folder))
      for (const fs::directory_entry &item : fs::directory_iterator(folder))
        if (item.path().extension() == ".json")
          files.emplace(item.path().stem().string(), item.path());
  }

  dem::ParticleShape made(const std::string &name, double radius,
                          const std::string &location)
  {
    // The last state of a run goes on as it was: about its own origin.
    if (const auto file = last.find(name); file != last.end())
    {
      const ShapeFile shape = read_shape(file->second.string());
      particles.shapes.add(as_written(shape, source.order), shape);
      return dem::make_shape(
          particles.shapes.back(), radius,
          dem::sphere_rule(parameters.breakage.quadrature_rings));
    }
    const auto file = given.find(name);
    if (file == given.end())
      refuse(name, location);
    const ShapeFile shape = read_shape(file->second.string());
    particles.shapes.add(load_with_warnings(shape, source.order), shape);
    return dem::make_shape(particles.shapes.back(), radius);
  }

  [[noreturn]] void refuse(const std::string &name,
                           const std::string &location) const
  {
    std::vector<std::string> names = {"sphere"};
    for (const auto &[known, file] : given)
      names.push_back(known);
    const std::string near = nearest(name, names);
    throw InputError(location + ": shape " + name +
                     ": must be sphere or the name of a file in " +
                     source.section + "/shapes without its ending" +
                     (near.empty() ? "" : ", did you mean " + near + "?"));
  }

  const Case &parameters;
  const PlacedSource &source;
  PlacedParticles &particles;
  std::map<std::string, fs::path> given, last;
  std::map<std::string, dem::ParticleShape> bodies;
};

std::uint8_t material_of(const std::string &name,
                         const std::string &other_solid,
                         const std::string &location)
{
  if (name.empty() || name == "particle")
    return 0;
  if (name == "other" && !other_solid.empty())
    return 1;
  throw InputError(
      location + ": material " + name +
      ": must be particle (section Particle)" +
      (other_solid.empty() ? "" : " or other (" + other_solid + ")"));
}
} // namespace

double PlacedParticles::smallest_radius() const
{
  double smallest = std::numeric_limits<double>::infinity();
  for (const dem::ParticleShape &one : body)
    smallest = std::min(smallest, dem::mean_radius(one));
  return smallest;
}

void PlacedParticles::add_at_rest(const std::vector<dem::ParticleShape> &bodies,
                                  const std::vector<dem::Placement> &at,
                                  const std::string &section,
                                  std::size_t n_other)
{
  const std::size_t n = size() + bodies.size();
  for (std::size_t k = 0; k < bodies.size(); ++k)
  {
    name.push_back("particle " + std::to_string(k + 1) + " of " + section);
    material.push_back(k < n_other ? 1 : 0);
  }
  body.insert(body.end(), bodies.begin(), bodies.end());
  placement.insert(placement.end(), at.begin(), at.end());
  velocity.resize(n, dem::Vec3::Zero());
  spin.resize(n, dem::Vec3::Zero());
}

PlacedParticles place_particles(const Case &parameters,
                                const PlacedSource &source)
{
  const ParticleFiles files = particle_files(parameters, source);
  const Packing packing = read_placed_particles(files.particles.string());
  PlacedParticles placed;
  placed.box = packing.box;
  NamedShapes shapes(parameters, source, files.shapes, placed);
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
        material_of(material, source.other_solid, location));
    placed.name.push_back(location);
  }
  return placed;
}

} // namespace spall
