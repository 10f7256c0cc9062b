#include "facet_stream.h"

#include <dem/binary.h>

#include <stdexcept>

namespace dem
{
namespace
{
/// What a FacetContactPoint has beside the vertices that carry it.
struct ContactPointHead
{
  std::int64_t triangle = -1;
  std::array<double, 3> weight{};
  Vec3 normal = Vec3::Zero();
  std::int64_t walls = 1;
  double extra = 0.;
  std::int64_t n_shares = 0;
};
} // namespace

/// Heads in one column, the shares of all contact_points in another.
void write_contact_points(std::ostream &out,
                          const FacetContactPoints &contact_points)
{
  std::vector<ContactPointHead> heads;
  std::vector<VertexShare> shares;
  heads.reserve(contact_points.point.size());
  for (const FacetContactPoint &contact_point : contact_points.point)
  {
    heads.push_back(
        {contact_point.triangle, contact_point.weight, contact_point.normal,
         contact_point.shares.walls, contact_point.shares.extra,
         static_cast<std::int64_t>(contact_point.shares.of.size())});
    shares.insert(shares.end(), contact_point.shares.of.begin(),
                  contact_point.shares.of.end());
  }
  write_column(out, heads);
  write_column(out, shares);
  write_column(out, contact_points.reactivation);
  write_column(out, contact_points.ridge);
}

void read_contact_points(std::istream &in, FacetContactPoints &contact_points)
{
  std::vector<ContactPointHead> heads;
  std::vector<VertexShare> shares;
  read_column(in, heads);
  read_column(in, shares);
  read_column(in, contact_points.reactivation);
  read_column(in, contact_points.ridge);
  contact_points.point.resize(heads.size());
  auto next = shares.cbegin();
  for (std::size_t k = 0; k < heads.size(); ++k)
  {
    const ContactPointHead &head = heads[k];
    if (head.n_shares < 0 || head.n_shares > shares.cend() - next)
      throw std::runtime_error("checkpoint is damaged");
    FacetContactPoint &contact_point = contact_points.point[k];
    contact_point.triangle = head.triangle;
    contact_point.weight = head.weight;
    contact_point.normal = head.normal;
    contact_point.shares.walls = head.walls;
    contact_point.shares.extra = head.extra;
    contact_point.shares.of.assign(next, next + head.n_shares);
    next += head.n_shares;
  }
}
} // namespace dem
