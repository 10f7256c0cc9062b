#pragma once

#include <dem/parallel/ranks.h>

#include <cstring>
#include <sstream>
#include <string>

/// Parcels through the streams of dem/binary.h.
namespace dem
{
/// What was written, for a rank.
inline Parcel parcel_for(int rank, const std::ostringstream &out)
{
  const std::string text = out.str();
  Parcel parcel{rank, std::vector<std::byte>(text.size())};
  std::memcpy(parcel.content.data(), text.data(), text.size());
  return parcel;
}

/// Reads a parcel from its beginning.
struct ParcelReader
{
  explicit ParcelReader(const Parcel &parcel)
      : stream(
            std::string(reinterpret_cast<const char *>(parcel.content.data()),
                        parcel.content.size())),
        size(parcel.content.size())
  {
  }
  /// Bytes that have not been read.
  std::size_t n_left()
  {
    return size - static_cast<std::size_t>(stream.tellg());
  }

  std::istringstream stream;

private:
  std::size_t size;
};
} // namespace dem
