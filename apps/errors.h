#pragma once

#include <stdexcept>

namespace spall
{
/// Bad input: one clear line with file, section, key, value and what is
/// allowed. The program prints it and ends with status 1.
class InputError : public std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/// The run failed: what, when, where the last checkpoint is. Status 2.
class RunFailure : public std::runtime_error
{
  using std::runtime_error::runtime_error;
};
} // namespace spall
