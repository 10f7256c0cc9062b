#pragma once

#include <dem/binary.h>
#include <dem/parallel/ranks.h>

#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace dem
{
/// The text that the first rank has. Collective.
std::string of_first_rank(const Ranks &ranks, const std::string &text);

/// `read` takes in on all ranks what `write` has written on the first one; on
/// one rank alone neither is called. Collective.
template <class Write, class Read>
void take_from_first_rank(const Ranks &ranks, const Write &write,
                          const Read &read)
{
  if (ranks.size() == 1)
    return;
  std::ostringstream own(std::ios::binary);
  if (ranks.rank() == 0)
    write(own);
  std::istringstream first(of_first_rank(ranks, std::move(own).str()),
                           std::ios::binary);
  read(first);
}

/// The entries that the first rank has, see write_column(). Collective.
template <class Entry>
std::vector<Entry> of_first_rank(const Ranks &ranks, std::vector<Entry> entries)
{
  take_from_first_rank(
      ranks, [&](std::ostream &out) { write_column(out, entries); },
      [&](std::istream &in) { read_column(in, entries); });
  return entries;
}

/// The plain data that the first rank has, see write_value(). Collective.
template <class Value>
Value of_first_rank(const Ranks &ranks, Value value)
{
  take_from_first_rank(
      ranks, [&](std::ostream &out) { write_value(out, value); },
      [&](std::istream &in) { read_value(in, value); });
  return value;
}
} // namespace dem
