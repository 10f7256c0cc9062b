#include "specimen/last_state.h"

#include "case/parameter.h"
#include "errors.h"
#include "run/whole_file.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <sstream>

namespace spall
{
namespace
{
/// Names of the series that particles have, and the files that they need.
class WrittenShapes
{
public:
  explicit WrittenShapes(const ShapeLibrary &its_library) : library(its_library)
  {
    for (std::size_t k = 0; k < library.size(); ++k)
    {
      known.emplace(library[k].get(), k);
      taken.insert(library.entry(k).name);
      licences.insert(library.entry(k).licence);
    }
  }

  std::string name_of(const dem::ParticleShape &shape, std::int64_t id)
  {
    if (!shape.series)
      return "sphere";
    const auto found = known.find(shape.series.get());
    if (found == known.end())
      return add_broken(*shape.series, id);
    const ShapeLibrary::Entry &entry = library.entry(found->second);
    if (used.insert(found->second).second)
      add(*shape.series, entry);
    return entry.name;
  }

  const std::vector<ShapeFile> &files() const { return all; }

private:
  std::string add_broken(const dem::Coefficients &series, std::int64_t id)
  {
    ShapeLibrary::Entry entry;
    entry.name = "particle_" + std::to_string(id);
    while (!taken.insert(entry.name).second)
      entry.name += "_";
    entry.source = "particle " + std::to_string(id) +
                   " of a run of Spall, after it has broken";
    for (const std::string &one : licences)
      if (!one.empty())
        entry.licence += (entry.licence.empty() ? "" : "; ") + one;
    add(series, entry);
    return entry.name;
  }

  void add(const dem::Coefficients &series, const ShapeLibrary::Entry &entry)
  {
    all.push_back({dem::order_of(series.size()), series, entry.name,
                   entry.source, entry.licence, ""});
  }

  const ShapeLibrary &library;
  std::map<const dem::Coefficients *, std::size_t> known;
  std::set<std::size_t> used;
  std::set<std::string> taken, licences;
  std::vector<ShapeFile> all;
};

void write_row(std::ostream &out, const dem::ParticleSystem &all, std::size_t i)
{
  const dem::Vec3 &x = all.position(i), &v = all.velocity(i), &w = all.spin(i);
  const dem::Quaternion &q = all.orientation(i);
  for (const double number :
       {x.x(), x.y(), x.z(), all.radius(i), q.w(), q.x(), q.y(), q.z(), v.x(),
        v.y(), v.z(), w.x(), w.y(), w.z()})
    out << number_text(number) << ',';
}

/// Rows in the order of the ids.
std::vector<std::size_t> rows_by_id(const dem::ParticleSystem &all)
{
  std::vector<std::size_t> rows(all.size());
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  std::ranges::sort(rows, {}, [&](std::size_t row) { return all.id[row]; });
  return rows;
}
/// A file of the run, not one that the user has named.
void write_file(const std::filesystem::path &path, const ShapeFile &shape)
try
{
  write_shape(path.string(), shape);
}
catch (const InputError &error)
{
  throw RunFailure(error.what());
}
} // namespace

void write_last_state(const std::filesystem::path &folder,
                      const dem::ParticleSystem &all,
                      const ShapeLibrary &shapes)
{
  std::error_code status;
  std::filesystem::remove(folder / "particles.csv", status);
  std::filesystem::remove_all(folder / "shapes", status);
  if (all.size() == 0)
    return;
  WrittenShapes written(shapes);
  std::ostringstream out;
  out << "x,y,z,radius,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz,shape,material\n";
  for (const std::size_t i : rows_by_id(all))
  {
    write_row(out, all, i);
    out << written.name_of(all.shape[i], all.id[i]) << ','
        << (all.material[i] == 0 ? "particle" : "other") << '\n';
  }
  if (!written.files().empty())
    std::filesystem::create_directories(folder / "shapes", status);
  for (const ShapeFile &file : written.files())
    write_file(folder / "shapes" / (file.name + ".json"), file);
  write_text(folder / "particles.csv", out.str());
}
} // namespace spall
