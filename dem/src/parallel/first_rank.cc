#include <dem/parallel/first_rank.h>

#include <span>
#include <vector>

namespace dem
{
std::string of_first_rank(const Ranks &ranks, const std::string &text)
{
  if (ranks.size() == 1)
    return text;
  const std::string own = ranks.rank() == 0 ? text : std::string();
  const std::vector<std::byte> first =
      ranks.gather(std::as_bytes(std::span(own))).front();
  return {reinterpret_cast<const char *>(first.data()), first.size()};
}
} // namespace dem
