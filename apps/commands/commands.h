#pragma once

#include <span>
#include <string>
#include <vector>

namespace spall
{
/// Each command gets the words after its own name, throws InputError or
/// RunFailure, and returns the exit status otherwise.
using Words = std::span<const std::string>;

int template_command(Words words);
int check_command(Words words);
int run_command(Words words);
int report_command(Words words);
int study_command(Words words);
int shape_command(Words words);
int bench_command(Words words);
int verify_command(Words words);

/// Prints the lines about old names of a case or study to stderr.
void report_deprecated(const std::vector<std::string> &lines);
} // namespace spall
