#pragma once

#include <algorithm>
#include <cstdint>
#include <istream>
#include <ostream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace dem
{
/// Plain memory to and from a stream, bit for bit, on one kind of machine.
/// Only for types without pointers (Eigen's fixed-size ones included): what
/// owns memory has a destructor, and is refused.
template <class T>
void write_value(std::ostream &out, const T &value)
{
  static_assert(std::is_standard_layout_v<T> &&
                std::is_trivially_destructible_v<T>);
  out.write(reinterpret_cast<const char *>(&value), sizeof(T));
}

/// Throws std::runtime_error at the end of the stream.
template <class T>
void read_value(std::istream &in, T &value)
{
  static_assert(std::is_standard_layout_v<T> &&
                std::is_trivially_destructible_v<T>);
  if (!in.read(reinterpret_cast<char *>(&value), sizeof(T)))
    throw std::runtime_error("checkpoint ends too early");
}

template <class T>
void write_column(std::ostream &out, const std::vector<T> &column)
{
  static_assert(std::is_standard_layout_v<T> &&
                std::is_trivially_destructible_v<T>);
  write_value(out, static_cast<std::uint64_t>(column.size()));
  out.write(reinterpret_cast<const char *>(column.data()),
            static_cast<std::streamsize>(column.size() * sizeof(T)));
}

template <class T>
void read_column(std::istream &in, std::vector<T> &column)
{
  static_assert(std::is_standard_layout_v<T> &&
                std::is_trivially_destructible_v<T>);
  std::uint64_t n = 0;
  read_value(in, n);
  if (n > (std::uint64_t{1} << 40) / sizeof(T))
    throw std::runtime_error("checkpoint is damaged");
  // In pieces: a wrong size ends with the stream, not with the memory.
  constexpr std::uint64_t piece = std::uint64_t{1} << 20;
  column.clear();
  for (std::uint64_t done = 0; done < n;)
  {
    const std::uint64_t now = std::min(piece, n - done);
    column.resize(done + now);
    if (!in.read(reinterpret_cast<char *>(column.data() + done),
                 static_cast<std::streamsize>(now * sizeof(T))))
      throw std::runtime_error("checkpoint ends too early");
    done += now;
  }
}

/// A text, and back.
inline void write_name(std::ostream &out, const std::string &name)
{
  write_column(out, std::vector<char>(name.begin(), name.end()));
}

inline std::string read_name(std::istream &in)
{
  std::vector<char> name;
  read_column(in, name);
  return {name.begin(), name.end()};
}
} // namespace dem
