#include <dem/parallel/first_rank.h>
#include <dem/parallel/shared_input.h>

namespace dem
{
SharedInput::SharedInput(const Ranks &ranks, std::istream *source)
    : buffer(ranks, source), in(&buffer)
{
}

SharedInput::Buffer::int_type SharedInput::Buffer::underflow()
{
  constexpr std::size_t piece_size = std::size_t{1} << 20;
  if (source)
  {
    piece.resize(piece_size);
    source->read(piece.data(), static_cast<std::streamsize>(piece_size));
    piece.resize(static_cast<std::size_t>(source->gcount()));
  }
  piece = of_first_rank(ranks, piece);
  setg(piece.data(), piece.data(), piece.data() + piece.size());
  return piece.empty() ? traits_type::eof()
                       : traits_type::to_int_type(piece.front());
}
} // namespace dem
