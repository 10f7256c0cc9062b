#include "case/file.h"

#include "case/checks.h"
#include "case/data_folders.h"
#include "case/deprecated.h"
#include "case/fields.h"
#include "case/notices.h"
#include "case/source.h"
#include "errors.h"
#include "run/digest.h"

#include <deal.II/base/parameter_handler.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>

namespace spall
{
namespace
{
namespace fs = std::filesystem;

std::string hint(const std::string &word, const std::vector<std::string> &known)
{
  const std::string near = nearest(word, known);
  return near.empty() ? "" : ", did you mean " + near + "?";
}

/// What to do about a section that no case has.
std::string section_hint(const std::string &name,
                         const std::vector<std::string> &known)
{
  if (name == "Study")
    return "; this is a study: spall study";
  const std::string near = hint(name, known);
  if (!near.empty())
    return near;
  std::string all;
  for (const std::string &one : known)
    all += (all.empty() ? ": must be one of " : ", ") + one;
  return all;
}

/// What to do about a key that its section does not have.
std::string key_hint(const Assignment &a, const std::vector<std::string> &keys,
                     const std::vector<Parameter> &list)
{
  std::string others;
  for (const Parameter &parameter : list)
    if (parameter.key == a.key)
      others += (others.empty() ? "" : ", ") + parameter.section;
  return others.empty() ? hint(a.key, keys) : ": it is in " + others;
}

/// Throws InputError unless section and key are in the list.
void check_known(const Assignment &a, const std::vector<Parameter> &list)
{
  std::vector<std::string> names, keys;
  for (const Parameter &parameter : list)
  {
    if (names.empty() || names.back() != parameter.section)
      names.push_back(parameter.section);
    if (parameter.section == a.section)
      keys.push_back(parameter.key);
    if (parameter.section == a.section && parameter.key == a.key)
      return;
  }
  const std::string start =
      a.location + ": " + a.section + "/" + a.key + " = " + a.value + ": ";
  if (keys.empty())
    throw InputError(start + "no section of this name" +
                     section_hint(a.section, names));
  throw InputError(start + "no key of this name in section " + a.section +
                   key_hint(a, keys, list));
}

/// Every parameter as text; what is allowed is checked on assignment, with
/// the location of the value.
void declare(dealii::ParameterHandler &handler,
             const std::vector<Parameter> &list)
{
  for (const Parameter &parameter : list)
  {
    handler.enter_subsection(parameter.section);
    handler.declare_entry(parameter.key, value_text(parameter),
                          dealii::Patterns::Anything(), parameter.sentence);
    handler.leave_subsection();
  }
}

std::string get(dealii::ParameterHandler &handler, const std::string &section,
                const std::string &key)
{
  handler.enter_subsection(section);
  std::string value = handler.get(key);
  handler.leave_subsection();
  return value;
}

void set(dealii::ParameterHandler &handler, const Assignment &a)
{
  handler.enter_subsection(a.section);
  handler.set(a.key, a.value);
  handler.leave_subsection();
}

/// What the assignments of files and command line come to.
struct Values
{
  dealii::ParameterHandler handler;
  SetLocations locations;
  std::vector<std::string> deprecated;
};

/// Returns the present name, Section/key.
std::string take(Values &values, Assignment a,
                 const std::vector<Parameter> &list)
{
  use_present_names(a, list, values.deprecated);
  check_known(a, list);
  std::string name = a.section + "/" + a.key;
  values.locations[name] = a.location;
  set(values.handler, a);
  return name;
}

/// Checks the names of a file, stores its locations and its values.
/// deal.II's own parser supports no quotes.
void take_file(Values &values, const std::string &file,
               const std::vector<Parameter> &list)
{
  std::set<std::string> names;
  for (const Assignment &a : read_assignments(file))
    if (const std::string name = take(values, a, list);
        !names.insert(name).second)
      throw InputError(a.location + ": " + a.section + "/" + a.key + " = " +
                       a.value + ": " + name +
                       " is set twice, by its deprecated and its present name");
}

std::vector<fs::path> search_folders(const Case &parameters)
{
  std::vector<fs::path> folders = data_folders();
  folders.insert(folders.begin(), fs::path(parameters.file).parent_path());
  return folders;
}

bool is_preset(const Override &o)
{
  return o.section.empty();
}

/// Of a kind of case. Throws InputError that names those that there are.
std::string preset_file(const Case &parameters, const Override &preset)
{
  const std::string &name = preset.value;
  const std::string &kind = parameters.kind;
  std::set<std::string> known;
  for (const fs::path &data : search_folders(parameters))
  {
    std::error_code status;
    for (const auto &entry :
         fs::directory_iterator(data / "presets" / kind, status))
    {
      if (entry.path().filename() == name + ".prm")
        return entry.path().string();
      known.insert(entry.path().stem().string());
    }
  }
  std::string names;
  for (const std::string &one : known)
    names += (names.empty() ? ": must be one of " : ", ") + one;
  throw InputError(
      preset.location + " preset=" + name +
      (known.empty() ? ": a case of kind " + kind + " has none" : names));
}

void take_overrides(Values &values, const Case &parameters,
                    std::span<const Override> overrides,
                    const std::vector<Parameter> &list)
{
  for (const Override &o : overrides)
    if (is_preset(o))
      for (const Assignment &a : read_assignments(preset_file(parameters, o)))
        take(values, a, list);
  for (const Override &o : overrides)
    if (!is_preset(o))
      take(values, o, list);
}

/// The parameters that a material file may set.
std::vector<Parameter> of_material(const std::vector<Parameter> &list,
                                   const std::string &file)
{
  std::vector<Parameter> result;
  for (const Parameter &parameter : list)
    if (is_material_section(parameter.section))
      result.push_back(parameter);
  std::vector<std::string> notes;
  for (Assignment a : read_assignments(file))
    if (use_present_names(a, list, notes); !is_material_section(a.section))
      throw InputError(
          a.location + ": " + a.section + "/" + a.key + " = " + a.value +
          ": a material file has only the sections Particle, Wall, "
          "MembraneContact and Breakage");
  return result;
}

/// Values from the handler into the fields of the case: of the walls, or of all
/// other sections.
void assign_all(Values &values, const std::vector<Parameter> &list,
                bool of_walls)
{
  for (const Parameter &parameter : list)
  {
    if (is_wall_section(parameter.section) != of_walls)
      continue;
    const std::string name = parameter.section + "/" + parameter.key;
    const auto location = values.locations.find(name);
    if (location == values.locations.end())
      continue; // the default stays
    const std::string text =
        get(values.handler, parameter.section, parameter.key);
    try
    {
      assign(parameter, text);
    }
    catch (const std::invalid_argument &error)
    {
      throw InputError(location->second + ": " + name + " = " + text + ": " +
                       error.what());
    }
  }
}
} // namespace

Override parse_override(const std::string &text, const std::string &location)
{
  constexpr std::string_view preset = "preset=";
  if (text.starts_with(preset))
    return {"", "preset", text.substr(preset.size()), location};
  const std::size_t equal = text.find('=');
  const std::size_t slash = text.substr(0, equal).rfind('/');
  if (slash == std::string::npos || equal == std::string::npos || slash == 0 ||
      equal <= slash + 1)
    throw InputError(location + " " + text +
                     ": must be Section/key=value or preset=NAME");
  return {text.substr(0, slash), text.substr(slash + 1, equal - slash - 1),
          text.substr(equal + 1), location};
}

namespace
{
/// Value of the file or the command line; the first kind if neither does. May
/// be the name of no kind.
std::string kind_said(const std::string &file,
                      std::span<const Override> overrides)
{
  std::string name = test_kinds().front().name;
  for (const Assignment &a : read_assignments(file))
    if (a.section == "Case" && a.key == "kind")
      name = a.value;
  for (const Override &o : overrides)
    if (o.section == "Case" && o.key == "kind")
      name = o.value;
  return name;
}

/// Throws InputError for a section or key that cases of this kind do not have.
void check_kind(const Case &parameters, const std::vector<Parameter> &list,
                const SetLocations &locations)
{
  const std::string by_default =
      locations.contains("Case/kind") ? "" : " (the default: set Case/kind)";
  const auto refuse = [&](const auto &of_source, const std::string &what)
  {
    throw InputError(of_source.second + ": " + of_source.first +
                     ": a case of kind " + parameters.kind + by_default +
                     " has no " + what);
  };
  for (const ListedSection &section : sections(parameters))
    if (!section.is_of(parameters.kind))
      for (const auto &location : locations)
        if (location.first.starts_with(section.name + "/"))
          refuse(location, "section " + section.name);
  for (const Parameter &parameter : list)
    if (!parameter.is_of(parameters.kind))
      if (const auto location = locations.find(parameter.name());
          location != locations.end())
        refuse(*location,
               "key " + parameter.key + " in section " + parameter.section);
}

/// Where the file or folder is, if it exists and is readable.
std::optional<std::string> path_of(const Case &of, const std::string &name)
{
  std::error_code status;
  if (fs::path(name).is_absolute())
    return fs::exists(name, status) ? std::optional(name) : std::nullopt;
  for (const fs::path &folder : search_folders(of))
    if (fs::exists(folder / name, status))
      return fs::absolute(folder / name).lexically_normal().string();
  return std::nullopt;
}

/// Of a file, of the shape files of a folder, or of the last particles of a
/// run with their shapes.
std::uint64_t digest_of(const fs::path &path)
{
  if (!fs::is_directory(path))
    return digest_of_file(path);
  if (const fs::path last = path / "particles.csv"; fs::exists(last))
  {
    Digest run;
    run.add(hex_text(digest_of_file(last)));
    if (fs::is_directory(path / "shapes"))
      run.add(hex_text(digest_of(path / "shapes")));
    return run.value();
  }
  std::error_code status;
  std::map<fs::path, std::uint64_t> files;
  for (const fs::directory_entry &item : fs::directory_iterator(path, status))
    if (item.path().extension() == ".json")
      files.emplace(item.path().filename(), digest_of_file(item.path()));
  Digest all;
  for (const auto &[name, digest] : files)
    all.add(name.string() + hex_text(digest));
  return all.value();
}

/// Of the files that a checkpoint identifies. One that is not there is
/// refused where it is used.
void note_contents(Case &of)
{
  for (const Parameter &parameter : parameters_of(of))
    if (parameter.is_path)
      if (const std::string &name = *std::get<std::string *>(parameter.value);
          !name.empty())
        if (const auto path = path_of(of, name))
          of.contents[parameter.section + "/" + parameter.key] =
              digest_of(*path);
}
/// The walls that file and command line name, in this order. Throws InputError
/// for a name that columns and messages cannot have.
void add_named_walls(Case &c, const std::string &file,
                     std::span<const Override> overrides)
{
  const auto add = [&c](const Assignment &a)
  {
    if (!is_wall_section(a.section))
      return;
    const std::string name = wall_of(a.section);
    if (!is_wall_name(name))
      throw InputError(a.location + ": " + a.section +
                       ": the name of a wall is letters, digits and _");
    if (std::ranges::find(c.walls, name, &WallSection::name) == c.walls.end())
      c.walls.emplace_back().name = name;
  };
  for (const Assignment &a : read_assignments(file))
    add(a);
  for (const Override &o : overrides)
    add(o);
}

/// The materials take the parameters of their laws.
void choose_laws(Case &c)
{
  const auto number = [](const std::string &law)
  { return static_cast<std::size_t>(dem::contact_law_number(law)); };
  c.particle.law_values = c.pair_laws.at(number(c.particle.law));
  c.wall.law_values = c.wall_laws.at(number(c.wall.law));
  for (WallSection &wall : c.walls)
    wall.material.law_values = c.wall_laws.at(number(wall.material.law));
}
} // namespace

Case read_case(const std::string &file, std::span<const Override> overrides)
{
  const std::string kind = kind_said(file, overrides);
  const bool is_kind = find_kind(kind);
  Case result = default_case(is_kind ? kind : test_kinds().front().name);
  result.file = file;
  add_named_walls(result, file, overrides);
  const std::vector<Parameter> list = parameters_of(result);
  Values values;
  declare(values.handler, list);
  take_file(values, file, list);
  take_overrides(values, result, overrides, list);

  if (is_kind) // else Case/kind itself is refused below
    check_kind(result, list, values.locations);
  const std::string named = get(values.handler, "Material", "file");
  if (!named.empty())
  {
    const std::string material = find_path(result, "Material", "file", named);
    const std::vector<Parameter> allowed = of_material(list, material);
    values.locations.clear();
    take_file(values, material, allowed);
    take_file(values, file, list); // the case wins
    take_overrides(values, result, overrides, list);
  }
  assign_all(values, list, false);
  for (WallSection &wall : result.walls)
    wall.material = result.wall; // what it does not say itself
  assign_all(values, list, true);
  choose_laws(result);
  result.deprecated = values.deprecated;
  note_contents(result);

  check_case(result,
             [&](const std::string &section, const std::string &key)
             {
               const auto location = values.locations.find(section + "/" + key);
               return location == values.locations.end() ? file + " (default)"
                                                         : location->second;
             });
  result.notices = notices_on(result, list, values.locations);
  return result;
}

std::string find_path(const Case &parameters, const std::string &section,
                      const std::string &key, const std::string &path)
{
  if (const auto found = path_of(parameters, path))
  {
    if (found->find_first_of("\r\n") != std::string::npos)
      throw InputError(parameters.file + ": " + section + "/" + key + " = " +
                       path + ": is " + *found +
                       ": a path must have no line break");
    return *found;
  }
  std::string looked;
  if (!fs::path(path).is_absolute())
    for (const fs::path &folder : search_folders(parameters))
      looked += (looked.empty() ? ", looked in " : ", ") +
                (folder.empty() ? "." : folder.string());
  throw InputError(parameters.file + ": " + section + "/" + key + " = " + path +
                   ": no such file or folder" + looked);
}
} // namespace spall
