#include <dem/parallel/faults.h>

namespace dem
{
std::string first_fault(const Ranks &ranks, const std::string &own)
{
  if (ranks.size() == 1)
    return own;
  for (const std::vector<std::byte> &message :
       ranks.gather(std::as_bytes(std::span(own))))
    if (!message.empty())
      return {reinterpret_cast<const char *>(message.data()), message.size()};
  return {};
}
} // namespace dem
