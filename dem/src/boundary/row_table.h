#pragma once

#include <cstdint>
#include <span>
#include <vector>

/// Tables whose rows have any number of entries: columns of entries, and where
/// each row begins in them (one more number than rows).
namespace dem
{
/// Calls call(first, end) for the entries of each of these rows.
template <class Call>
void for_rows(const std::vector<std::int32_t> &row_start,
              const std::vector<std::int32_t> &rows, const Call &call)
{
  for (const std::int32_t row : rows)
  {
    const auto r = static_cast<std::size_t>(row);
    call(static_cast<std::size_t>(row_start[r]),
         static_cast<std::size_t>(row_start[r + 1]));
  }
}

/// The entries of some rows. A column that is empty is not there.
template <class Entry>
std::vector<Entry> entries_of(const std::vector<Entry> &column,
                              const std::vector<std::int32_t> &row_start,
                              const std::vector<std::int32_t> &rows)
{
  std::vector<Entry> some;
  if (column.empty())
    return some;
  for_rows(row_start, rows,
           [&](std::size_t first, std::size_t end)
           {
             const auto entries = std::span(column).subspan(first, end - first);
             some.insert(some.end(), entries.begin(), entries.end());
           });
  return some;
}

/// Where these rows begin in entries_of().
inline std::vector<std::int32_t>
starts_of(const std::vector<std::int32_t> &row_start,
          const std::vector<std::int32_t> &rows)
{
  std::vector<std::int32_t> starts{0};
  for_rows(row_start, rows,
           [&starts](std::size_t first, std::size_t end) {
             starts.push_back(starts.back() +
                              static_cast<std::int32_t>(end - first));
           });
  return starts;
}

/// Rows of another table come after those of this one.
inline void append_starts(const std::vector<std::int32_t> &more,
                          std::vector<std::int32_t> &row_start)
{
  const std::int32_t first = row_start.back();
  for (std::size_t r = 1; r < more.size(); ++r)
    row_start.push_back(first + more[r]);
}

template <class Entry>
void append_entries(const std::vector<Entry> &more, std::vector<Entry> &column)
{
  column.insert(column.end(), more.begin(), more.end());
}
} // namespace dem
