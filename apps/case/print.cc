#include "case/fields.h"
#include "case/file.h"
#include "case/text.h"
#include "errors.h"

#include <algorithm>
#include <sstream>

namespace spall
{
namespace
{
/// A comment of at most 79 characters a line.
void print_comment(std::ostream &out, const std::string &indent,
                   const std::string &text)
{
  std::istringstream words(text);
  std::string line = indent + "#";
  for (std::string word; words >> word;)
  {
    if (line.size() + 1 + word.size() > 79)
    {
      out << line << '\n';
      line = indent + "#";
    }
    line += " " + word;
  }
  out << line << '\n';
}

/// Sentence with unit, range and reason, and the default of another value.
std::string describe(const Parameter &parameter, const Parameter &by_default)
{
  std::string text = parameter.sentence;
  text.append(" [").append(parameter.unit).append("]");
  if (!std::holds_alternative<std::string *>(parameter.value))
    text.append(" Allowed: ").append(allowed(parameter)).append(".");
  if (const std::string usually = usual(parameter); !usually.empty())
    text.append(" Usual: ").append(usually).append(".");
  if (const std::string value = value_text(by_default);
      value != value_text(parameter))
    text.append(" Default: ")
        .append(value.empty() ? "empty" : value)
        .append(".");
  return text;
}

/// The value as a .prm has it: in double quotes where it would read as another.
std::string prm_value(const std::string &value)
{
  const bool is_plain = value.find('#') == std::string::npos &&
                        !value.starts_with('"') && !value.ends_with('\\') &&
                        value.find_first_of(" \t") != 0 &&
                        !value.ends_with(' ') && !value.ends_with('\t');
  if (is_plain)
    return value;
  std::string quoted = "\"";
  for (const char c : value)
    quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

/// "Walls/hopper" as the two sections that it is in a file.
std::vector<std::string> levels_of(const std::string &section)
{
  const std::size_t slash = section.find('/');
  if (slash == std::string::npos)
    return {section};
  return {section.substr(0, slash), section.substr(slash + 1)};
}

/// With absolute paths and no material file.
Case as_run(const Case &parameters)
{
  Case resolved = parameters;
  for (Parameter &path : parameters_of(resolved))
    if (path.is_path)
      if (auto *text = std::get<std::string *>(path.value); !text->empty())
        *text = find_path(parameters, path.section, path.key, *text);

  resolved.material.clear(); // its values are all there
  return resolved;
}

void print_case(std::ostream &out, Case of)
{
  Case defaults = defaults_of(of);
  const std::vector<Parameter> list = parameters_of(of),
                               by_default = parameters_of(defaults);
  for (const ListedSection &section : sections(of))
  {
    if (!section.is_of(of.kind))
      continue;
    out << '\n';
    print_comment(out, "", section.sentence);
    const std::vector<std::string> names = levels_of(section.name);
    for (std::size_t k = 0; k < names.size(); ++k)
      out << std::string(2 * k, ' ') << "subsection " << names[k] << '\n';
    const std::string indent(2 * names.size(), ' ');
    for (std::size_t k = 0; k < list.size(); ++k)
      if (const Parameter &parameter = list[k];
          parameter.section == section.name && parameter.is_of(of.kind))
      {
        print_comment(out, indent, describe(parameter, by_default[k]));
        const std::string value = prm_value(value_text(parameter));
        out << indent << "set " << parameter.key << " ="
            << (value.empty() ? "" : " ") << value << '\n';
      }
    for (std::size_t k = names.size(); k-- > 0;)
      out << std::string(2 * k, ' ') << "end\n";
  }
}
} // namespace

std::string parameters_as_run(const Case &parameters)
{
  std::ostringstream out;
  print_case(out, as_run(parameters));
  return out.str();
}

std::vector<std::string> changes_since(const std::string &printed,
                                       const Case &parameters)
{
  Case now = as_run(parameters);
  const std::vector<Parameter> list = parameters_of(now);
  std::vector<std::string> changes;
  for (const Assignment &then : read_assignments(printed))
    for (const Parameter &parameter : list)
      if (parameter.section == then.section && parameter.key == then.key)
        if (const std::string value = value_text(parameter);
            value != then.value)
          changes.push_back(parameter.name() + " = " + value + ", was " +
                            then.value);
  return changes;
}

std::string without_comments(const std::string &printed)
{
  std::istringstream lines(printed);
  std::string kept;
  for (std::string line; std::getline(lines, line);)
    if (const std::size_t first = line.find_first_not_of(' ');
        first != std::string::npos && line[first] != '#')
      kept += line + '\n';
  return kept;
}

std::string resolved_case(const Case &parameters)
{
  std::ostringstream out;
  print_comment(out, "", "Every parameter as run. Case: " + parameters.file);
  if (!parameters.material.empty())
    print_comment(out, "",
                  "Its material file, written out: " + parameters.material);
  return out.str() + parameters_as_run(parameters);
}

Case template_defaults(const std::string &kind)
{
  Case defaults = default_case(kind);
  if (const auto set = find_kind(kind)->set_template)
    set(defaults);
  return defaults;
}

std::string template_case(const std::string &kind)
{
  if (!find_kind(kind))
    throw InputError("template " + kind + ": kind must be one of " +
                     joined(kind_names()) + ", or parameters");
  Case defaults = template_defaults(kind);
  defaults.material = "materials/graded_aggregate.prm";
  std::ostringstream out;
  print_comment(out, "",
                "Case of kind " + kind +
                    " with every parameter: at its default, unless another "
                    "default is named. Paths: absolute, or from the folder of "
                    "this file, or from Spall's data/.");
  print_case(out, defaults);
  return out.str();
}

} // namespace spall
