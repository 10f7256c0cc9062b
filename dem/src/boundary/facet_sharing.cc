// Facet surfaces whose particles get other rows, or go to other ranks.
#include "facet_stream.h"
#include "row_table.h"

#include <dem/binary.h>
#include <dem/boundary/facet_boundary.h>

#include <algorithm>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace dem
{
namespace
{
using Rows = std::vector<std::int32_t>;

std::size_t index(std::int32_t number)
{
  return static_cast<std::size_t>(number);
}

/// Which particle each new row had; some may be gone.
Rows old_rows(const Rows &new_row)
{
  Rows old(new_row.size(), -1);
  std::size_t n_kept = 0;
  for (std::size_t i = 0; i < new_row.size(); ++i)
    if (new_row[i] >= 0)
    {
      old[index(new_row[i])] = static_cast<std::int32_t>(i);
      ++n_kept;
    }
  old.resize(n_kept);
  return old;
}

/// Rows of the candidates that have these particles, in their order; `sorted`
/// are the particles of all rows.
Rows rows_with(const Rows &sorted, const Rows &particles)
{
  Rows rows;
  for (const std::int32_t particle : particles)
  {
    const auto at = std::ranges::lower_bound(sorted, particle);
    if (at != sorted.end() && *at == particle)
      rows.push_back(static_cast<std::int32_t>(at - sorted.begin()));
  }
  return rows;
}

/// Entries for some of `n` contacts; of a column that has no entry for each of
/// them: none.
template <class Entry>
std::vector<Entry> some_of(const std::vector<Entry> &column, std::size_t n,
                           const Rows &contacts)
{
  std::vector<Entry> some;
  if (column.size() == n)
    for (const std::int32_t k : contacts)
      some.push_back(column[index(k)]);
  return some;
}
} // namespace

void FacetBoundary::keep_particles(const Rows &new_row)
{
  Rows order(near.particle.size());
  std::iota(order.begin(), order.end(), 0);
  const auto row_of = [&](std::int32_t candidate)
  { return new_row[index(near.particle[index(candidate)])]; };
  std::erase_if(order, [&](std::int32_t row) { return row_of(row) < 0; });
  std::ranges::sort(order, {}, row_of);
  if (watch.row_start.size() == near.row_start.size())
    watch = watch.select(order, old_rows(new_row));
  Rows particles;
  for (const std::int32_t row : order)
    particles.push_back(row_of(row));
  near = near.select(order);
  near.particle = std::move(particles);
}

void FacetBoundary::pack_particles(std::ostream &out,
                                   const Rows &particles) const
{
  const auto put = [&out](const auto &column) { write_column(out, column); };
  const Rows packed = rows_with(near.particle, particles);
  FacetCandidates some = near.select(packed);
  std::unordered_map<std::int32_t, std::int32_t> parcel_row;
  for (const std::int32_t particle : particles)
    parcel_row.emplace(particle, static_cast<std::int32_t>(parcel_row.size()));
  for (std::int32_t &particle : some.particle)
    particle = parcel_row.at(particle);
  FacetCandidates::visit(some, put);
  FacetMotion motion;
  if (watch.row_start.size() == near.row_start.size())
    motion = watch.select(packed, particles);
  motion.vertices.clear(); // every rank has them
  FacetMotion::visit(motion, put);
}

void FacetBoundary::unpack_particles(std::istream &in, std::size_t first)
{
  const auto get = [&in](auto &column) { read_column(in, column); };
  FacetCandidates more;
  FacetCandidates::visit(more, get);
  for (std::int32_t &particle : more.particle)
    particle += static_cast<std::int32_t>(first);
  near.append(more);
  FacetMotion motion;
  FacetMotion::visit(motion, get);
  watch.append(motion);
}

template <class Self, class Visit>
void FacetBoundary::visit_work_space(Self &self, const Visit &visit)
{
  visit(self.rows);
  visit(self.overlap);
  visit(self.extra);
}

void FacetBoundary::keep_contacts(const Rows &order)
{
  visit_work_space(*this, [&](auto &column)
                   { column = some_of(column, batch.size(), order); });
  Boundary::keep_contacts(order);
  contact_points = contact_points.select(order);
  number_contacts();
}

std::vector<std::int32_t> FacetBoundary::sort_contacts()
{
  // Those of a particle stay in their order: it is that of their slots.
  Rows order = Boundary::sort_contacts();
  visit_work_space(*this, [&](auto &column)
                   { column = some_of(column, order.size(), order); });
  contact_points = contact_points.select(order);
  number_contacts();
  return order;
}

void FacetBoundary::number_contacts()
{
  for (std::size_t k = 0; k < batch.size(); ++k)
    batch.b[k] = static_cast<std::int32_t>(k);
}

void FacetBoundary::pack_contacts(std::ostream &out, const Rows &contacts) const
{
  write_contact_points(out, contact_points.select(contacts));
  visit_work_space(*this,
                   [&](const auto &column) {
                     write_column(out, some_of(column, batch.size(), contacts));
                   });
}

void FacetBoundary::unpack_contacts(std::istream &in)
{
  FacetContactPoints more;
  read_contact_points(in, more);
  contact_points.append(more);
  visit_work_space(*this,
                   [&](auto &column)
                   {
                     auto entries = column;
                     read_column(in, entries);
                     append_entries(entries, column);
                     if (column.size() != batch.size())
                       column.clear(); // found again before it is read
                   });
  number_contacts();
}

void FacetBoundary::swap_contacts(Boundary &other)
{
  auto &another = static_cast<FacetBoundary &>(other);
  Boundary::swap_contacts(other);
  std::swap(contact_points, another.contact_points);
  std::swap(rows, another.rows);
  std::swap(overlap, another.overlap);
  std::swap(extra, another.extra);
}

void FacetBoundary::take_contact(std::size_t k, const Boundary &other,
                                 std::size_t l)
{
  Boundary::take_contact(k, other, l);
  const auto &another = static_cast<const FacetBoundary &>(other);
  const auto take = [k, l](auto &column, const auto &from)
  {
    if (k < column.size() && l < from.size())
      column[k] = from[l];
  };
  take(contact_points.point, another.contact_points.point);
  take(contact_points.reactivation, another.contact_points.reactivation);
  take(contact_points.ridge, another.contact_points.ridge);
  take(rows, another.rows);
  take(overlap, another.overlap);
  take(extra, another.extra);
}
} // namespace dem
