#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// Concurrent runs of this program.
namespace spall
{
/// Runs a program with its words, of which the first names it ("spall": this
/// one), standard output and error into `log`;
/// returns the exit status, or -1. For up to 256 threads at a time.
int run_program(const std::vector<std::string> &words,
                const std::filesystem::path &log);

/// From now on SIGINT and SIGTERM go to the running programs as SIGTERM, so
/// that each leaves its checkpoint, and no other is to be begun.
void pass_on_stops();

/// Whether such a signal has come.
bool are_programs_stopped();
} // namespace spall
