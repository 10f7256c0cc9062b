#include "run/digested.h"

#include "run/digest.h"

#include <dem/binary.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <streambuf>

namespace spall
{
namespace
{
/// Passes bytes on and takes their digest.
class DigestBuffer : public std::streambuf
{
public:
  explicit DigestBuffer(std::streambuf &target) : to(target) {}

  std::uint64_t value() const { return digest.value(); }

protected:
  std::streamsize xsputn(const char *bytes, std::streamsize n) override
  {
    digest.add({bytes, static_cast<std::size_t>(n)});
    return to.sputn(bytes, n);
  }
  int_type overflow(int_type c) override
  {
    const char byte = traits_type::to_char_type(c);
    return xsputn(&byte, 1) == 1 ? c : traits_type::eof();
  }

private:
  std::streambuf &to;
  Digest digest;
};
} // namespace

void write_digested(std::ostream &out,
                    const std::function<void(std::ostream &)> &write)
{
  DigestBuffer buffer(*out.rdbuf());
  std::ostream digested(&buffer);
  write(digested);
  if (!digested)
    out.setstate(std::ios::badbit);
  dem::write_value(out, buffer.value());
}

bool is_as_digested(const std::filesystem::path &path)
{
  std::error_code status;
  const std::uint64_t size = std::filesystem::file_size(path, status);
  std::uint64_t expected = 0;
  if (status || size < sizeof expected)
    return false;
  std::ifstream in(path, std::ios::binary);
  Digest digest;
  std::array<char, 1 << 16> bytes;
  for (std::uint64_t left = size - sizeof expected; left > 0 && in;)
  {
    const std::size_t n = std::min<std::uint64_t>(left, bytes.size());
    in.read(bytes.data(), static_cast<std::streamsize>(n));
    digest.add({bytes.data(), n});
    left -= n;
  }
  in.read(reinterpret_cast<char *>(&expected), sizeof expected);
  return in && digest.value() == expected;
}
} // namespace spall
