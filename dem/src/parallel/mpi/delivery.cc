#include "delivery.h"

#include "check.h"
#include "zoltan_plan.h"

#include <dem/assert.h>

#include <algorithm>

namespace dem
{
namespace
{
constexpr int parcel_tag = 1;
/// MPI counts bytes by int: long parcels go in pieces of this size.
constexpr std::size_t piece = std::size_t{1} << 30;

struct Announcement
{
  std::int64_t sender = 0;
  std::int64_t size = 0; ///< in bytes
};

/// Empty room for what arrives, ordered by the rank of the sender.
std::vector<Parcel> announce(const std::vector<Parcel> &parcels,
                             std::shared_ptr<const Communicator> planning)
{
  std::vector<int> destination;
  std::vector<Announcement> leaving;
  for (const Parcel &parcel : parcels)
  {
    destination.push_back(parcel.rank);
    leaving.push_back(
        {planning->rank(), static_cast<std::int64_t>(parcel.content.size())});
  }
  ZoltanPlan plan(std::move(planning), destination);
  std::vector<Announcement> arriving(plan.n_received());
  plan.forward(leaving.data(), sizeof(Announcement), arriving.data());
  std::vector<Parcel> room(arriving.size());
  for (std::size_t k = 0; k < room.size(); ++k)
  {
    room[k].rank = static_cast<int>(arriving[k].sender);
    room[k].content.resize(static_cast<std::size_t>(arriving[k].size));
  }
  std::ranges::sort(room, {}, &Parcel::rank);
  return room;
}

/// Calls post(data, count) for every piece of a content.
template <class Post>
void for_pieces(std::vector<std::byte> &content, const Post &post)
{
  for (std::size_t begin = 0; begin < content.size(); begin += piece)
    post(content.data() + begin,
         static_cast<int>(std::min(piece, content.size() - begin)));
}

using Requests = std::vector<MPI_Request>;

void post_receives(const Communicator &own, std::vector<Parcel> &arriving,
                   Requests &requests)
{
  for (Parcel &parcel : arriving)
    if (parcel.rank != own.rank())
      for_pieces(parcel.content,
                 [&](std::byte *data, int count)
                 {
                   check_mpi(MPI_Irecv(data, count, MPI_BYTE, parcel.rank,
                                       parcel_tag, own.get(),
                                       &requests.emplace_back()),
                             "receive a parcel");
                 });
}

void post_sends(const Communicator &own, std::vector<Parcel> &leaving,
                Requests &requests)
{
  for (Parcel &parcel : leaving)
    if (parcel.rank != own.rank())
      for_pieces(parcel.content,
                 [&](std::byte *data, int count)
                 {
                   check_mpi(MPI_Isend(data, count, MPI_BYTE, parcel.rank,
                                       parcel_tag, own.get(),
                                       &requests.emplace_back()),
                             "send a parcel");
                 });
}

void keep_own(int rank, std::vector<Parcel> &leaving,
              std::vector<Parcel> &arriving)
{
  const auto from = std::ranges::find(leaving, rank, &Parcel::rank);
  if (from != leaving.end())
    std::ranges::find(arriving, rank, &Parcel::rank)->content =
        std::move(from->content);
}

[[maybe_unused]] bool has_one_for_each_rank(const std::vector<Parcel> &parcels)
{
  std::vector<int> ranks;
  ranks.reserve(parcels.size());
  for (const Parcel &parcel : parcels)
    ranks.push_back(parcel.rank);
  std::ranges::sort(ranks);
  return std::ranges::adjacent_find(ranks) == ranks.end();
}
} // namespace

std::vector<Parcel>
deliver_parcels(const Communicator &own,
                std::shared_ptr<const Communicator> planning,
                std::vector<Parcel> parcels)
{
  DEM_ASSERT(has_one_for_each_rank(parcels));
  std::vector<Parcel> arriving = announce(parcels, std::move(planning));
  Requests requests;
  post_receives(own, arriving, requests);
  post_sends(own, parcels, requests);
  keep_own(own.rank(), parcels, arriving);
  check_mpi(MPI_Waitall(static_cast<int>(requests.size()), requests.data(),
                        MPI_STATUSES_IGNORE),
            "deliver parcels");
  return arriving;
}
} // namespace dem
