#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>
#include <string>
#include <string_view>

namespace spall
{
/// Digest of bytes in the order they come (FNV-1a, 64 bits). It tells
/// files and settings apart; it is no protection against intent.
class Digest
{
public:
  void add(std::string_view bytes)
  {
    for (const char c : bytes)
    {
      state ^= static_cast<unsigned char>(c);
      state *= 1099511628211u;
    }
  }
  void add(std::span<const double> numbers)
  {
    add({reinterpret_cast<const char *>(numbers.data()), numbers.size_bytes()});
  }

  std::uint64_t value() const { return state; }

private:
  std::uint64_t state = 14695981039346656037u;
};

/// Of the bytes of a file; of none if it cannot be read, as a folder.
inline std::uint64_t digest_of_file(const std::string &path)
{
  Digest digest;
  std::error_code status;
  if (!std::filesystem::is_regular_file(path, status))
    return digest.value();
  std::ifstream file(path, std::ios::binary);
  digest.add(std::string(std::istreambuf_iterator<char>(file), {}));
  return digest.value();
}

/// Sixteen hexadecimal digits.
inline std::string hex_text(std::uint64_t value)
{
  std::string text;
  for (int shift = 60; shift >= 0; shift -= 4)
    text += "0123456789abcdef"[(value >> shift) & 15u];
  return text;
}
} // namespace spall
