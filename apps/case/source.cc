#include "case/source.h"

#include "errors.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>

namespace spall
{
namespace
{
using Json = nlohmann::json;

std::string trim(const std::string &text)
{
  const char *blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string::npos)
    return "";
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// A value in double quotes, where two of them stand for one. Nothing if the
/// text is no such value, or has more behind it than a comment.
std::optional<std::string> quoted_value(const std::string &text)
{
  if (!text.starts_with('"'))
    return {};
  std::string value;
  for (std::size_t k = 1; k < text.size(); ++k)
  {
    if (text[k] != '"')
      value += text[k];
    else if (text.substr(k, 2) == "\"\"")
      value += text[k++];
    else if (const std::string rest = trim(text.substr(k + 1));
             rest.empty() || rest.starts_with('#'))
      return value;
    else
      return {};
  }
  return {};
}

/// The section that has sections of its own.
const std::string walls_section = "Walls";

/// The lines of a .prm one by one: subsection X, set key = value,
/// set key = "value", end, #.
class PrmScanner
{
public:
  explicit PrmScanner(const std::string &file_) : file(file_) {}

  void take(const std::string &raw)
  {
    ++line;
    if (take_quoted(raw))
      return;
    const std::size_t comment = raw.find('#');
    const std::string text = trim(raw.substr(0, comment));
    const bool is_inside = comment != std::string::npos && comment > 0 &&
                           raw[comment - 1] != ' ' && raw[comment - 1] != '\t';
    if (is_inside && text.starts_with("set"))
      refuse("cannot read \"" + trim(raw) +
             "\": a value with # must be in double quotes, a comment after a "
             "value must have a blank before its #");
    if (text.empty())
      return;
    const std::size_t blank = std::min(text.find_first_of(" \t"), text.size());
    const std::string verb = text.substr(0, blank);
    const std::string rest = trim(text.substr(blank));
    if (verb == "subsection" && !rest.empty())
      open(rest);
    else if (verb == "set" && rest.find('=') != std::string::npos)
      set(rest);
    else if (verb == "end" && rest.empty())
      close();
    else
      refuse("cannot read \"" + text +
             "\": a line is subsection NAME, set key = value, end or # text");
  }

  void finish() const
  {
    if (!section.empty())
      throw InputError(file + ": section " + section + " has no end");
  }

  std::vector<Assignment> assignments;

private:
  [[noreturn]] void refuse(const std::string &what) const
  {
    throw InputError(location() + ": " + what);
  }
  std::string location() const { return file + ":" + std::to_string(line); }

  void open(const std::string &name)
  {
    if (section == walls_section)
      section += "/" + name;
    else if (!section.empty())
      refuse("section " + name + " inside section " + section +
             ": sections are not nested, is an end missing?");
    else
      section = name;
  }

  void close()
  {
    if (section.empty())
      refuse("end without a section");
    const bool is_wall = section.starts_with(walls_section + "/");
    section = is_wall ? walls_section : "";
  }

  /// set key = "value"; false for any other line.
  bool take_quoted(const std::string &raw)
  {
    const std::string text = trim(raw);
    const std::size_t equal = text.find('=');
    if (equal > text.find('#') || equal == std::string::npos ||
        (!text.starts_with("set ") && !text.starts_with("set\t")))
      return false;
    const auto value = quoted_value(trim(text.substr(equal + 1)));
    if (value)
      add({section, trim(text.substr(4, equal - 4)), *value, location()});
    return value.has_value();
  }

  void set(const std::string &rest)
  {
    const std::size_t equal = rest.find('=');
    const Assignment a{section, trim(rest.substr(0, equal)),
                       trim(rest.substr(equal + 1)), location()};
    if (a.value.ends_with('\\'))
      refuse(a.section + "/" + a.key + " = " + a.value +
             ": a value is one line");
    add(a);
  }

  void add(const Assignment &a)
  {
    if (section.empty())
      refuse(a.key + " = " + a.value + ": set outside of a section");
    if (!seen.insert(a.section + "/" + a.key).second)
      refuse(a.section + "/" + a.key + " = " + a.value + ": set twice");
    assignments.push_back(a);
  }

  const std::string file;
  int line = 0;
  std::string section;
  std::set<std::string> seen;
};

std::vector<Assignment> scan_prm(const std::string &file, std::istream &in)
{
  PrmScanner scanner(file);
  skip_byte_order_mark(in);
  for (std::string line; std::getline(in, line);)
    scanner.take(line);
  scanner.finish();
  return std::move(scanner.assignments);
}

Json parse_json(const std::string &file, std::istream &in)
{
  std::vector<std::set<std::string>> keys;
  const auto watch = [&](int, Json::parse_event_t event, Json &parsed)
  {
    if (event == Json::parse_event_t::object_start)
      keys.emplace_back();
    else if (event == Json::parse_event_t::object_end)
      keys.pop_back();
    else if (event == Json::parse_event_t::key &&
             !keys.back().insert(parsed.get<std::string>()).second)
      throw InputError(file + ": " + parsed.get<std::string>() +
                       ": given twice in one object");
    return true;
  };
  try
  {
    return Json::parse(in, watch);
  }
  catch (const Json::parse_error &error)
  {
    const std::string what = error.what();
    const std::size_t at = what.find("at line");
    throw InputError(file + ": not valid JSON: " +
                     what.substr(at == std::string::npos ? 0 : at));
  }
  catch (const Json::out_of_range &error)
  {
    const std::string what = error.what(); // ends: number overflow ... '1e400'
    throw InputError(file + ": not valid JSON: " +
                     what.substr(std::min(what.find("number"), what.size())));
  }
}

const std::string form = "a case is {\"Section\": {\"key\": value}}";

/// The text of a value; of a list of numbers these with commas between them.
std::string text_of(const Json &value)
{
  if (!value.is_array())
    return value.is_string() ? value.get<std::string>() : value.dump();
  std::string text;
  for (const Json &one : value)
    text += (text.empty() ? "" : ", ") + one.dump();
  return text;
}

void add_entry(const std::string &file, Assignment a, const Json &value,
               std::vector<Assignment> &assignments)
{
  const bool is_list =
      value.is_array() && std::ranges::all_of(value, [](const Json &one)
                                              { return one.is_number(); });
  if ((value.is_structured() && !is_list) || value.is_null())
    throw InputError(file + ": " + a.section + "/" + a.key + ": " + form);
  a.value = text_of(value);
  assignments.push_back(std::move(a));
}

void add_entries(const std::string &file, const std::string &section,
                 const Json &entries, std::vector<Assignment> &assignments)
{
  for (const auto &[key, value] : entries.items())
    add_entry(file, {section, key, "", file}, value, assignments);
}

std::vector<Assignment> scan_json(const std::string &file, std::istream &in)
{
  const Json root = parse_json(file, in);
  if (!root.is_object())
    throw InputError(file + ": " + form);
  std::vector<Assignment> assignments;
  for (const auto &[section, entries] : root.items())
  {
    if (!entries.is_object())
      throw InputError(file + ": " + section + ": " + form);
    const bool has_sections = section == walls_section;
    for (const auto &[key, value] : entries.items())
      if (has_sections && value.is_object())
        add_entries(file, section + "/" + key, value, assignments);
      else
        add_entry(file, {section, key, "", file}, value, assignments);
  }
  return assignments;
}
} // namespace

void skip_byte_order_mark(std::istream &in)
{
  std::string start(3, '\0');
  in.read(start.data(), 3);
  in.clear();
  if (start != "\xEF\xBB\xBF")
    in.seekg(0);
}

std::vector<Assignment> read_assignments(const std::string &file)
{
  namespace fs = std::filesystem;
  if (!fs::exists(file))
    throw InputError(file + ": no such file");
  if (fs::is_directory(file))
    throw InputError(file + ": is a folder, not a case file");
  std::ifstream in(file);
  if (!in)
    throw InputError(file + ": cannot be read");
  const std::string ending = fs::path(file).extension().string();
  if (ending == ".prm")
    return scan_prm(file, in);
  if (ending == ".json")
    return scan_json(file, in);
  throw InputError(file + ": a case file ends in .prm or .json");
}
} // namespace spall
