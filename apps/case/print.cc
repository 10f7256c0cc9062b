#include "case/fields.h"
#include "case/file.h"
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

/// Sentence with unit, range and reason.
std::string describe(const Parameter &parameter)
{
  std::string text = parameter.sentence;
  text.append(" [").append(parameter.unit).append("]");
  if (!std::holds_alternative<std::string *>(parameter.value))
    text.append(" Allowed: ").append(allowed(parameter)).append(".");
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

void print_case(std::ostream &out, Case of)
{
  const std::vector<Parameter> list = parameters_of(of);
  for (const Section &section : sections())
  {
    if (!section.is_of(of.kind))
      continue;
    out << '\n';
    print_comment(out, "", section.sentence);
    out << "subsection " << section.name << '\n';
    for (const Parameter &parameter : list)
      if (parameter.section == section.name &&
          is_among(parameter.kinds, of.kind))
      {
        print_comment(out, "  ", describe(parameter));
        const std::string value = prm_value(value_text(parameter));
        out << "  set " << parameter.key << " =" << (value.empty() ? "" : " ")
            << value << '\n';
      }
    out << "end\n";
  }
}

std::string joined(const std::vector<std::string> &words)
{
  std::string text;
  for (const std::string &word : words)
    text += (text.empty() ? "" : ", ") + word;
  return text;
}

/// Cell of a Markdown table.
std::string cell(const std::string &text)
{
  std::string escaped;
  for (const char c : text)
    escaped += c == '|' ? std::string("\\|") : std::string(1, c);
  return escaped.empty() ? "(empty)" : escaped;
}
} // namespace

std::string parameters_as_run(const Case &parameters)
{
  Case resolved = parameters;
  for (Parameter &path : parameters_of(resolved))
    if (path.is_path)
      if (auto *text = std::get<std::string *>(path.value); !text->empty())
        *text = find_path(parameters, path.section, path.key, *text);

  resolved.material.clear(); // its values are all there
  std::ostringstream out;
  print_case(out, resolved);
  return out.str();
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

Case usual_case(CaseKind kind)
{
  Case usual = default_case(kind);
  if (kind == CaseKind::dynamic_triaxial)
    usual.coupling.exchange = ExchangeChoice::every_step;
  if (kind == CaseKind::subgrade)
    usual.coupling.exchange = ExchangeChoice::one_pass;
  return usual;
}

std::string template_case(const std::string &kind)
{
  const auto found = std::ranges::find(kind_names, kind);
  if (found == kind_names.end())
    throw InputError("template " + kind + ": kind must be one of " +
                     joined(kind_names) + ", or parameters");
  Case defaults = usual_case(static_cast<CaseKind>(found - kind_names.begin()));
  defaults.material = "materials/graded_aggregate.prm";
  std::ostringstream out;
  print_comment(out, "",
                "Case of kind " + kind +
                    " with the default of every parameter. Paths: absolute, or "
                    "from the folder of this file, or from Spall's data/.");
  print_case(out, defaults);
  return out.str();
}

namespace
{
/// The default, or those of the kinds that have it where they differ.
std::string default_text(const Section &section,
                         const std::vector<CaseKind> &kinds, std::size_t place)
{
  std::vector<std::string> texts, lines;
  for (std::size_t k = 0; k < kind_names.size(); ++k)
    if (const auto kind = static_cast<CaseKind>(k);
        section.is_of(kind) && is_among(kinds, kind))
    {
      Case defaults = default_case(kind);
      texts.push_back(value_text(parameters_of(defaults)[place]));
      lines.push_back(texts.back() + " (" + kind_names[k] + ")");
    }
  const bool is_one = std::ranges::all_of(texts, [&](const std::string &text)
                                          { return text == texts[0]; });
  return is_one ? texts[0] : joined(lines);
}

std::string kinds_text(const std::vector<CaseKind> &kinds)
{
  std::vector<std::string> names;
  for (const CaseKind kind : kinds)
    names.push_back(kind_names[static_cast<std::size_t>(kind)]);
  return names.empty() ? "" : " Kinds: " + joined(names) + ".";
}
} // namespace

std::string parameter_tables()
{
  Case defaults;
  const std::vector<Parameter> list = parameters_of(defaults);
  std::ostringstream out;
  out << "# Parameters of a case\n\nGenerated by `spall template parameters`, "
         "do not edit. Values are SI.\n"
         "A value with `#` stands in double quotes: `set shapes = "
         "\"lot#2/shapes\"`; two double quotes inside stand for one.\n";
  for (const Section &section : sections())
  {
    out << "\n## " << section.name << "\n\n"
        << section.sentence << kinds_text(section.kinds) << "\n\n"
        << "| key | unit | default | allowed | meaning |\n"
        << "|---|---|---|---|---|\n";
    for (std::size_t k = 0; k < list.size(); ++k)
      if (const Parameter &p = list[k]; p.section == section.name)
        out << "| `" << p.key << "` | " << p.unit << " | "
            << cell(default_text(section, p.kinds, k)) << " | " << allowed(p)
            << " | " << cell(p.sentence + kinds_text(p.kinds)) << " |\n";
  }
  return out.str();
}
} // namespace spall
