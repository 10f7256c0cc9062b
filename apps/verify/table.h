#pragma once

#include "case.h"

#include <iosfwd>
#include <span>

namespace spall::verify
{
/// A row as it was computed, with the case it belongs to.
struct Result
{
  std::string family, name, source;
  Row row;
};

/// Runs the cases of a family one after the other.
std::vector<Result> run(const Family &family);

/// Aligned columns for a terminal, one line per row; fails are marked.
void print_table(std::span<const Result> results, std::ostream &out);
/// family,case,quantity,unit,reference,computed,error_1,tolerance_1,held,source
void write_csv(std::span<const Result> results, std::ostream &out);
/// One table per family in Markdown, one row per case: its source, how many
/// numbers it has, and error and tolerance of the one nearest to its tolerance.
void write_markdown(std::span<const Family> families,
                    std::span<const Result> results, std::ostream &out);
} // namespace spall::verify
