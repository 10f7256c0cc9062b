#pragma once

#include "fuzz.h"
#include "run/digest.h"

#include <string>

namespace fuzz
{
/// A state file that the program wrote, changed as an input says. The first
/// byte of the input chooses: 0: the rest is the file; 1: the rest are changes;
/// 2: changes, after which the digest at the end is made right again, so that
/// the reader goes on. A change is three bytes: offset (two) and new value;
/// with an odd number of bytes left over the file is cut at the last offset.
inline std::string changed(const std::string &sound, const std::uint8_t *data,
                           std::size_t size)
{
  if (size == 0)
    return "";
  if (data[0] % 3 == 0)
    return std::string(bytes_of(data + 1, size - 1));
  std::string file = sound;
  std::size_t offset = 0;
  for (std::size_t k = 1; k + 2 < size && !file.empty(); k += 3)
  {
    offset = (data[k] + 256u * data[k + 1]) % file.size();
    file[offset] = static_cast<char>(data[k + 2]);
  }
  if ((size - 1) % 3 == 1)
    file.resize(offset);
  if (data[0] % 3 == 1 || file.size() < sizeof(std::uint64_t))
    return file;
  file.resize(file.size() - sizeof(std::uint64_t));
  spall::Digest digest;
  digest.add(file);
  const std::uint64_t value = digest.value();
  file.append(reinterpret_cast<const char *>(&value), sizeof value);
  return file;
}
} // namespace fuzz
