#pragma once

#include "commands/commands.h"

#include <dem/shape/fit.h>

#include <cstdint>
#include <string>
#include <vector>

namespace spall
{
/// Options of `spall shape`; those that were not given have their default.
struct ShapeWords
{
  std::vector<std::string> inputs; ///< mesh, shape file or folders of shapes
  std::string out, json;
  std::string source, licence;
  std::string unit = "m"; ///< of a mesh
  int order = 20;
  dem::FitOptions fit;
  /// Share of length or volume of a mesh that a fit may miss [-].
  double max_misfit = 0.15;
  /// Radius of the patches that curvatures of a mesh are fitted to, over the
  /// mean radius [-].
  double patch = 0.05;
  int count = 0; ///< particles to generate [-]
  std::uint64_t seed = 0;
  bool has_order = false, has_unit = false, has_fit = false, has_seed = false,
       has_patch = false;
};

/// Throws InputError with one line: the option, its value, what is allowed.
ShapeWords parse_shape_words(Words words);

/// Throws InputError: what was wrong, then how the command is used.
[[noreturn]] void fail_shape_usage(const std::string &what = "");
} // namespace spall
