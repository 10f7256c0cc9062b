#pragma once

#include "errors.h"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <unistd.h>

namespace fuzz
{
/// Ends the program with this message, as a fault that the fuzzer keeps.
[[noreturn]] inline void fail(const std::string &what)
{
  std::fprintf(stderr, "fuzz: %s\n", what.c_str());
  std::abort();
}

/// A message that a user gets is one line, and not a long one.
inline void check_message(const std::string &message)
{
  if (message.empty() || message.size() > 2000)
    fail("message of " + std::to_string(message.size()) + " bytes");
}

/// Calls a reader on bad input: it returns, or refuses what it got in one of
/// the two ways that end the program with status 1. Any other exception ends
/// the fuzzer.
template <class Read>
void try_to(const Read &read)
{
  try
  {
    read();
  }
  catch (const spall::InputError &error)
  {
    check_message(error.what());
  }
  catch (const std::invalid_argument &error)
  {
    check_message(error.what());
  }
}

inline std::string_view bytes_of(const std::uint8_t *data, std::size_t size)
{
  return {reinterpret_cast<const char *>(data), size};
}

/// A folder of this process, removed at its end.
class ScratchFolder
{
public:
  ScratchFolder()
      : folder(std::filesystem::temp_directory_path() /
               ("spall_fuzz_" + std::to_string(::getpid())))
  {
    std::filesystem::create_directories(folder);
  }
  ~ScratchFolder()
  {
    std::error_code status;
    std::filesystem::remove_all(folder, status);
  }
  ScratchFolder(const ScratchFolder &) = delete;
  ScratchFolder &operator=(const ScratchFolder &) = delete;

  /// Path of a file of this name with these bytes.
  std::string write(const std::string &name, std::string_view bytes) const
  {
    const std::filesystem::path path = folder / name;
    std::ofstream out(path, std::ios::binary);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!out)
      fail("cannot write " + path.string());
    return path.string();
  }

  const std::filesystem::path &path() const { return folder; }

private:
  const std::filesystem::path folder;
};

inline const ScratchFolder &scratch()
{
  static const ScratchFolder folder;
  return folder;
}
} // namespace fuzz

/// What libFuzzer calls with each input.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data,
                                      std::size_t size);
