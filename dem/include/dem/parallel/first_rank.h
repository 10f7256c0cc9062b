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

/// The entries that the first rank has, see write_column(). Collective.
template <class Entry>
std::vector<Entry> of_first_rank(const Ranks &ranks,
                                 const std::vector<Entry> &entries)
{
  if (ranks.size() == 1)
    return entries;
  std::ostringstream own(std::ios::binary);
  write_column(own, entries);
  std::istringstream first(of_first_rank(ranks, std::move(own).str()),
                           std::ios::binary);
  std::vector<Entry> its;
  read_column(first, its);
  return its;
}

/// The plain data that the first rank has, see write_value(). Collective.
template <class Value>
Value of_first_rank(const Ranks &ranks, const Value &value)
{
  if (ranks.size() == 1)
    return value;
  std::ostringstream own(std::ios::binary);
  write_value(own, value);
  std::istringstream first(of_first_rank(ranks, std::move(own).str()),
                           std::ios::binary);
  Value its;
  read_value(first, its);
  return its;
}
} // namespace dem
