#pragma once

namespace spall
{
/// The whole program: runs the command that the words of the command line name,
/// prints a failure as one line and returns the exit status (0 done, 1 bad
/// input, 2 the run failed). A program that adds contact laws, boundaries or
/// kinds of tests registers them first and then calls this.
int program_main(int argc, char **argv);
} // namespace spall
