#pragma once

#include "case/case.h"
#include "case/source.h"

#include <span>
#include <string>

namespace spall
{
/// An assignment from outside of the case file. That of a preset, a file of
/// settings in data/presets, has no section: "preset" = its name.
using Override = Assignment;

/// "Section/Key=value" or "preset=NAME", what follows --set unless `location`
/// says otherwise. Throws InputError.
Override parse_override(const std::string &text,
                        const std::string &location = "--set");

/// Reads and validates a .prm (or .json) case: defaults, then the material
/// file, then the case, then presets, then the other overrides. Throws
/// InputError.
Case read_case(const std::string &file, std::span<const Override> overrides);

/// Every parameter with its value, unit and sentence (paths made absolute).
std::string parameters_as_run(const Case &parameters);

/// A line for each parameter that has another value than in this file, which
/// parameters_as_run() printed. Throws InputError if it cannot be read.
std::vector<std::string> changes_since(const std::string &printed,
                                       const Case &parameters);

/// A printed case without its comments, which another version may word
/// otherwise.
std::string without_comments(const std::string &printed);

/// The same under the name of the case: a .prm that read_case takes and that
/// gives the same case.
std::string resolved_case(const Case &parameters);

/// The defaults of a kind, and what its cases must set besides.
Case template_defaults(const std::string &kind);

/// That as a commented case. Throws InputError.
std::string template_case(const std::string &kind);

/// docs/parameters/: one table per section in Markdown.
std::string parameter_tables();

/// A path of a case: absolute, or relative to the folder of the case file, or
/// to the data folder of Spall, whichever exists. Throws InputError naming
/// section and key if none does.
std::string find_path(const Case &parameters, const std::string &section,
                      const std::string &key, const std::string &path);
} // namespace spall
