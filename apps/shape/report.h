#pragma once

#include <dem/shape/fit.h>
#include <dem/shape/particle_shape.h>

#include <string>
#include <vector>

namespace spall
{
/// One figure of a shape: its key in JSON ends with the unit.
struct ShapeFact
{
  std::string key, label, unit;
  double value = 0.;
};

struct ShapeFacts
{
  std::string title; ///< key of the group in JSON
  std::vector<ShapeFact> facts;
};

/// All measures of a series; takes a third of a second.
ShapeFacts series_facts(const dem::Coefficients &coefficients);

/// Quality of a fit, and the series against the mesh; `seconds` is
/// what it took [s].
ShapeFacts fit_facts(const dem::ShapeFit &fit, double seconds);

/// Whether the series misses more than 1 % of the volume or 5 % of the length
/// of the mesh, and a line with the amount.
bool has_misfit(const dem::ShapeFit &fit);
std::string misfit_text(const dem::ShapeFit &fit);

void print_facts(const ShapeFacts &facts);

/// {title: {key: value}}. Throws InputError if the file cannot be written.
void write_facts(const std::string &path,
                 const std::vector<ShapeFacts> &groups);
} // namespace spall
