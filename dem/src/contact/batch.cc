#include "force_kernels.h"

#include <dem/contact/batch.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <ranges>
#include <type_traits>
#include <utility>

namespace dem
{
namespace
{
std::size_t whole_blocks(std::size_t n)
{
  return (n + ContactBatch::block - 1) / ContactBatch::block *
         ContactBatch::block;
}

Mat3 axes_of(const SideColumns &side, std::size_t k)
{
  const Triple<double> n = side.normal[k];
  return surface_axes({n.x, n.y, n.z});
}

/// The offset of contact k from the vertex of its paraboloid, body frame.
Vec3 along_surface(const SideColumns &side, std::size_t k)
{
  return axes_of(side, k).leftCols<2>() * side.offset[k];
}
} // namespace

Vec3 SideColumns::contact_point(std::size_t k) const
{
  const Triple<double> at = direction[k];
  if (!is_known(k))
    return Vec3(at.x, at.y, at.z).normalized();
  return paraboloid(k).at(along_surface(*this, k)).position.normalized();
}

double SideColumns::local_radius(std::size_t k,
                                 const Triple<double> &on_body) const
{
  const Triple<double> w = on_body - direction[k];
  const auto h = [this, k](std::size_t c)
  { return static_cast<double>(hessian[c][k]); };
  return radius[k] + dot(gradient[k], w) +
         0.5 * (h(0) * w.x * w.x + h(1) * w.y * w.y + h(2) * w.z * w.z) +
         h(3) * w.x * w.y + h(4) * w.x * w.z + h(5) * w.y * w.z;
}

Paraboloid SideColumns::paraboloid(std::size_t k) const
{
  const Mat3 axes = axes_of(*this, k);
  const auto tangents = axes.leftCols<2>();
  const auto entry = [this, k](std::size_t c)
  { return static_cast<double>(shape_operator[c][k]); };
  Eigen::Matrix2d planar;
  planar << entry(0), entry(1), entry(1), entry(2);
  return {{tangents * aside[k] + height[k] * axes.col(2), axes.col(2),
           tangents * planar * tangents.transpose()}};
}

SurfacePoint SideColumns::surface_at_contact_point(std::size_t k) const
{
  return paraboloid(k).at(along_surface(*this, k));
}

void SideColumns::set_paraboloid(std::size_t k, const SurfacePoint &vertex)
{
  const Vec3 &n = vertex.normal;
  normal.set(k, {n.x(), n.y(), n.z()});
  const Mat3 axes = axes_of(*this, k);
  const auto tangents = axes.leftCols<2>();
  aside.set(k, tangents.transpose() * vertex.position);
  const Vec3 up = vertex.position - tangents * aside[k];
  height[k] = up.dot(axes.col(2)) / axes.col(2).squaredNorm();
  const Eigen::Matrix2d planar =
      tangents.transpose() * vertex.shape_operator * tangents;
  const double entries[3] = {planar(0, 0), planar(0, 1), planar(1, 1)};
  for (std::size_t c = 0; c < 3; ++c)
    shape_operator[c][k] = static_cast<Narrow>(entries[c]);
  offset.set(k, Eigen::Vector2d::Zero());
}

void SideColumns::set_offset(std::size_t k, const Vec3 &w)
{
  offset.set(k, axes_of(*this, k).leftCols<2>().transpose() * w);
}

void ContactBatch::sort_by_pair(std::span<std::int32_t> contacts) const
{
  // Contacts of one pair of surfaces by where they are on A.
  const auto position = [this](std::int32_t k)
  {
    const auto row = static_cast<std::size_t>(k);
    if (!layout.has_contact_points)
      return std::array<Narrow, 3>{};
    const TripleColumn<Narrow> &u = side_a.direction;
    return std::array{u.x[row], u.y[row], u.z[row]};
  };
  const auto key = [this](std::int32_t k)
  {
    const auto row = static_cast<std::size_t>(k);
    return std::pair(a[row], b[row]);
  };
  std::ranges::sort(contacts,
                    [&](std::int32_t k, std::int32_t l)
                    {
                      if (key(k) != key(l))
                        return key(k) < key(l);
                      const auto at_k = position(k), at_l = position(l);
                      return at_k != at_l ? at_k < at_l : k < l;
                    });
}

/// A counting sort by A of short rows.
std::vector<std::int32_t> ContactBatch::by_pair() const
{
  const std::int32_t n_particles =
      n == 0 ? 0 : 1 + *std::max_element(a.begin(), a.begin() + n);
  std::vector<std::int32_t> start(static_cast<std::size_t>(n_particles) + 1, 0);
  for (std::size_t k = 0; k < n; ++k)
    start[static_cast<std::size_t>(a[k]) + 1] += is_vacant(k) ? 0 : 1;
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<std::int32_t> order(static_cast<std::size_t>(start.back()));
  std::vector<std::int32_t> next(start.begin(), start.end() - 1);
  for (std::size_t k = 0; k < n; ++k)
    if (!is_vacant(k))
      order[static_cast<std::size_t>(next[static_cast<std::size_t>(a[k])]++)] =
          static_cast<std::int32_t>(k);
  for (std::size_t i = 0; i + 1 < start.size(); ++i)
    sort_by_pair(std::span(order).subspan(
        static_cast<std::size_t>(start[i]),
        static_cast<std::size_t>(start[i + 1] - start[i])));
  return order;
}

std::size_t ContactBatch::n_vacant() const
{
  return static_cast<std::size_t>(std::ranges::count(displaced, vacant));
}

void ContactBatch::start(std::size_t k, std::int32_t first, std::int32_t second)
{
  const std::int32_t adds_to = layout.has_partners ? target[k] : 0;
  visit(
      layout,
      [k](bool is_there, auto &column)
      {
        if (is_there)
          column[k] = {};
      },
      *this);
  a[k] = first;
  b[k] = second;
  if (layout.has_partners)
    target[k] = adds_to;
}

void ContactBatch::vacate(std::size_t k)
{
  const ContactBatch before = extract(k);
  start(k, before.a[0], before.b[0]);
  const auto copy = [k](bool is_there, auto &to, const auto &from)
  {
    if (is_there)
      to[k] = from[0];
  };
  SideColumns::visit(copy, layout, layout.has_sides, side_a, before.side_a);
  SideColumns::visit(copy, layout, layout.has_sides && layout.has_partners,
                     side_b, before.side_b);
  overlap_offset[k] = kernel::closed_offset;
  displaced[k] = vacant;
  if (layout.has_partners)
    reactivation[k] = std::numeric_limits<double>::infinity();
}

void ContactBatch::clear_signs_of_zeros()
{
  const auto clear = [this](auto &column)
  {
    using Entry = std::ranges::range_value_t<decltype(column)>;
    for (std::size_t k = 0; k < std::min(n, column.size()); ++k)
    {
      if (has_force(k))
        continue;
      if constexpr (std::is_floating_point_v<Entry>)
        column[k] += Entry(0);
      else if constexpr (std::is_same_v<Entry, ParticleLoad>)
        column[k] += ParticleLoad{};
    }
  };
  visit(
      layout, [&clear](bool, auto &column) { clear(column); }, *this);
}

ContactHistory<double> ContactBatch::history(std::size_t k) const
{
  ContactHistory<double> history;
  history.shear = shear[k];
  if (layout.has_rolling)
  {
    history.rolling = rolling[k];
    history.rolling_compliance = rolling_compliance[k];
  }
  history.dashpot = dashpot[k];
  history.shear_compliance = shear_compliance[k];
  history.normal_force = normal_force[k];
  history.normal_energy =
      layout.has_attraction
          ? normal_energy[k]
          : layout.law.entry().energy(layout.law.values, normal_force[k],
                                      overlap[k]);
  if (layout.has_attraction)
    history.attraction = attraction[k];
  return history;
}

double ContactBatch::normal_stiffness(std::size_t k) const
{
  const ContactLaw &law = layout.law.entry();
  return law.scales_with_curvature
             ? law.exponent * pressing_force(k) / overlap[k]
             : law.spring(layout.law.values, {}, overlap[k]).stiffness;
}

double ContactBatch::stored_energy(std::size_t k) const
{
  const ContactHistory<double> springs = history(k);
  return springs.normal_energy + tangential_energy(springs);
}

void ContactBatch::rearrange(const BatchLayout &new_layout,
                             const std::vector<std::int32_t> &source)
{
  layout = new_layout;
  n = source.size();
  const std::size_t capacity = whole_blocks(n);
  const auto move = [&](bool is_there, auto &column)
  {
    std::decay_t<decltype(column)> fresh(is_there ? capacity : 0);
    if (is_there && !column.empty())
      for (std::size_t k = 0; k < n; ++k)
        if (source[k] >= 0)
          fresh[k] = column[static_cast<std::size_t>(source[k])];
    column = std::move(fresh);
  };
  visit(layout, move, *this);
}

ContactBatch ContactBatch::select(const std::vector<std::int32_t> &rows) const
{
  ContactBatch some;
  some.layout = layout;
  some.n = rows.size();
  const auto copy = [&rows](bool is_there, auto &to, const auto &from)
  {
    to.resize(is_there ? whole_blocks(rows.size()) : 0);
    for (std::size_t k = 0; is_there && k < rows.size(); ++k)
      to[k] = from[static_cast<std::size_t>(rows[k])];
  };
  visit(layout, copy, some, *this);
  return some;
}

void ContactBatch::append(const ContactBatch &more)
{
  const auto add = [&](bool is_there, auto &to, const auto &from)
  {
    if (!is_there)
      return;
    to.resize(n);
    to.insert(to.end(), from.begin(),
              from.begin() + static_cast<std::ptrdiff_t>(more.n));
    to.resize(whole_blocks(to.size()));
  };
  visit(layout, add, *this, more);
  n += more.n;
}

ContactBatch ContactBatch::extract(std::size_t k) const
{
  ContactBatch one;
  one.layout = layout;
  one.n = 1;
  const auto copy = [k](bool is_there, auto &to, const auto &from)
  {
    to.resize(is_there ? block : 0);
    if (is_there)
      to[0] = from[k];
  };
  visit(layout, copy, one, *this);
  return one;
}

void ContactBatch::replace(std::size_t k, const ContactBatch &one)
{
  const auto copy = [k](bool is_there, auto &to, const auto &from)
  {
    if (is_there)
      to[k] = from[0];
  };
  visit(layout, copy, *this, one);
}
} // namespace dem
