#include "parcel_stream.h"

#include <dem/binary.h>
#include <dem/parallel/series_pool.h>

#include <bit>
#include <set>
#include <stdexcept>

namespace dem
{
namespace
{
/// Two hashes of 64 bits in one pass (multiply and rotate; after Appleby's
/// MurmurHash3).
SeriesKey hash(const Coefficients &series)
{
  std::uint64_t first = 0x9e3779b97f4a7c15 ^ series.size(),
                second = 0xc2b2ae3d27d4eb4f + series.size();
  for (const double number : series)
  {
    const auto bits = std::bit_cast<std::uint64_t>(number);
    first = std::rotl(first ^ (bits * 0x87c37b91114253d5), 27) * 5 + 0x52dce729;
    second =
        std::rotl(second ^ (bits * 0x4cf5ad432745937f), 31) * 5 + 0x38495ab5;
  }
  return {first, second | 1}; // never that of a sphere
}

constexpr SeriesKey sphere{};
} // namespace

SeriesKey SeriesPool::add(const std::shared_ptr<const Coefficients> &series)
{
  if (!series)
    return sphere;
  if (const auto known = key_of.find(series.get()); known != key_of.end())
    return known->second;
  const SeriesKey key = hash(*series);
  series_of.try_emplace(key, series);
  // Only what the pool holds has an address that lasts.
  if (series_of[key] == series)
    key_of[series.get()] = key;
  return key;
}

void SeriesPool::deliver_series(const Ranks &ranks,
                                const std::vector<Parcel> &asked)
{
  std::vector<Parcel> answers;
  for (const Parcel &from : asked)
  {
    ParcelReader in(from);
    std::vector<SeriesKey> keys;
    read_column(in.stream, keys);
    std::ostringstream out;
    for (const SeriesKey &key : keys)
      write_column(out, *series_of.at(key));
    write_value(out, true); // never empty
    answers.push_back(parcel_for(from.rank, out));
  }
  for (const Parcel &from : ranks.deliver(std::move(answers)))
  {
    ParcelReader in(from);
    while (in.n_left() > sizeof(bool))
    {
      Coefficients series;
      read_column(in.stream, series);
      add(std::make_shared<const Coefficients>(std::move(series)));
    }
  }
}

std::vector<std::shared_ptr<const Coefficients>>
SeriesPool::fetch(const Ranks &ranks,
                  const std::vector<std::pair<int, SeriesKey>> &wanted)
{
  std::map<int, std::vector<SeriesKey>> missing;
  std::set<SeriesKey> asked;
  for (const auto &[rank, key] : wanted)
    if (key != sphere && !series_of.contains(key) && asked.insert(key).second)
      missing[rank].push_back(key);
  std::vector<Parcel> requests;
  for (const auto &[rank, keys] : missing)
  {
    std::ostringstream out;
    write_column(out, keys);
    requests.push_back(parcel_for(rank, out));
  }
  deliver_series(ranks, ranks.deliver(std::move(requests)));
  std::vector<std::shared_ptr<const Coefficients>> found;
  for (const auto &[rank, key] : wanted)
    found.push_back(key == sphere ? nullptr : series_of.at(key));
  return found;
}

void SeriesPool::prune()
{
  std::erase_if(series_of,
                [this](const auto &entry)
                {
                  const bool is_unused = entry.second.use_count() == 1;
                  if (is_unused)
                    key_of.erase(entry.second.get());
                  return is_unused;
                });
}
} // namespace dem
