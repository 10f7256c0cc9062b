#pragma once

#include <dem/parallel/ranks.h>

#include <istream>
#include <streambuf>
#include <string>

namespace dem
{
/// A stream that all ranks read alike, of which the first rank alone has the
/// source: it sends piece after piece, so that none holds the whole. Reading is
/// collective: every rank reads the same bytes in the same order.
class SharedInput
{
public:
  /// `source` counts on the first rank, and must be there as long as this; null
  /// on others.
  SharedInput(const Ranks &ranks, std::istream *source);

  std::istream &stream() { return in; }

private:
  class Buffer : public std::streambuf
  {
  public:
    Buffer(const Ranks &all, std::istream *from) : ranks(all), source(from) {}

  protected:
    int_type underflow() override;

  private:
    const Ranks &ranks;
    std::istream *source;
    std::string piece;
  };

  Buffer buffer;
  std::istream in;
};
} // namespace dem
