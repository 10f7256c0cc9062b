#pragma once

#include <dem/contact/law_table.h>
#include <dem/contact/narrow.h>
#include <dem/contact/paraboloid.h>
#include <dem/contact/side.h>
#include <dem/particles/particle_system.h>
#include <dem/vector.h>

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace dem
{
/// Components in columns, the layout of SIMD lanes.
template <class Number>
struct TripleColumn
{
  std::vector<Number> x, y, z;

  Triple<double> operator[](std::size_t k) const { return {x[k], y[k], z[k]}; }
  void set(std::size_t k, const Triple<double> &value)
  {
    x[k] = static_cast<Number>(value.x);
    y[k] = static_cast<Number>(value.y);
    z[k] = static_cast<Number>(value.z);
  }
  template <class Visit, class... Selves>
  static void visit(const Visit &call, bool is_there, Selves &...selves)
  {
    call(is_there, selves.x...);
    call(is_there, selves.y...);
    call(is_there, selves.z...);
  }
};

/// Components along two tangents of a surface.
struct PlanarColumn
{
  std::vector<Narrow> x, y;

  Eigen::Vector2d operator[](std::size_t k) const { return {x[k], y[k]}; }
  void set(std::size_t k, const Eigen::Vector2d &value)
  {
    x[k] = static_cast<Narrow>(value.x());
    y[k] = static_cast<Narrow>(value.y());
  }
  template <class Visit, class... Selves>
  static void visit(const Visit &call, bool is_there, Selves &...selves)
  {
    call(is_there, selves.x...);
    call(is_there, selves.y...);
  }
};

/// Which optional columns a batch has: only what its scene needs.
struct BatchLayout
{
  LawChoice law;                   ///< of these contacts
  bool has_attraction = false;     ///< the law attracts
  bool has_prefactors = false;     ///< of the law, from the curvatures
  bool has_rolling = false;        ///< a rolling spring
  bool has_sides = false;          ///< the surface of the particle(s)
  bool has_partners = false;       ///< B is a particle
  bool has_damage = false;         ///< cumulative factors and events
  bool has_reversal = false;       ///< where the counted energy turned last
  bool has_peak = false;           ///< the highest counted energy
  bool has_contact_points = false; ///< contacts follow their surfaces
};

/// Surface data of the particle on one side of each contact: the surface to
/// second order where it was evaluated last, and the curvatures there. Along
/// the branch that is the expansion of r about a direction, of contacts that
/// follow their surfaces the paraboloid about a point. The direction is zero
/// where nothing is known. Empty where the contacts do not read the shape.
struct SideColumns
{
  TripleColumn<Narrow> direction; ///< evaluated there, body frame, unit [-]
  std::vector<SideCurvature> curvature;

  /// Along the branch; radius 0: not known.
  std::vector<double> radius;                 ///< [m]
  TripleColumn<Narrow> gradient;              ///< surface gradient of r [m]
  std::array<std::vector<Narrow>, 6> hessian; ///< xx, yy, zz, xy, xz, yz [m]

  /// Contacts that follow their surfaces: Paraboloid; height 0: not known.
  /// In the axes f_1, f_2, f_3 of surface_axes(normal) the vertex is at (aside,
  /// height), and the contact an offset w along f_1 and f_2 from there.
  TripleColumn<Narrow> normal;                       ///< body frame [-]
  std::vector<double> height;                        ///< [m]
  PlanarColumn aside;                                ///< [m]
  std::array<std::vector<Narrow>, 3> shape_operator; ///< xx, xy, yy [1/m]
  PlanarColumn offset;                               ///< [m]

  bool is_known(std::size_t k) const
  {
    return radius.empty() ? !height.empty() && height[k] > 0. : radius[k] > 0.;
  }
  /// Where contact k is on the surface, unit [-].
  Vec3 contact_point(std::size_t k) const;
  /// r at a unit direction near the one of contact k, from the expansion [m].
  double local_radius(std::size_t k, const Triple<double> &on_body) const;
  /// What is known about the surface of contact k that follows it.
  Paraboloid paraboloid(std::size_t k) const;
  /// The surface where that contact is.
  SurfacePoint surface_at_contact_point(std::size_t k) const;
  /// Takes the surface about another point; the contact is there.
  void set_paraboloid(std::size_t k, const SurfacePoint &vertex);
  /// Where the contact is, along w of its paraboloid.
  void set_offset(std::size_t k, const Vec3 &w);

  template <class Visit, class... Selves>
  static void visit(const Visit &call, const BatchLayout &has, bool is_there,
                    Selves &...selves)
  {
    const bool has_radius = is_there && !has.has_contact_points,
               has_paraboloid = is_there && has.has_contact_points;
    TripleColumn<Narrow>::visit(call, is_there, selves.direction...);
    call(is_there, selves.curvature...);
    call(has_radius, selves.radius...);
    TripleColumn<Narrow>::visit(call, has_radius, selves.gradient...);
    for (std::size_t c = 0; c < 6; ++c)
      call(has_radius, selves.hessian[c]...);
    TripleColumn<Narrow>::visit(call, has_paraboloid, selves.normal...);
    call(has_paraboloid, selves.height...);
    PlanarColumn::visit(call, has_paraboloid, selves.aside...);
    for (std::size_t c = 0; c < 3; ++c)
      call(has_paraboloid, selves.shape_operator[c]...);
    PlanarColumn::visit(call, has_paraboloid, selves.offset...);
  }
};

/// Contacts and contacts-to-be of one kind in columns; entry k of every column
/// is the same contact. Columns are longer than size() by less than one block:
/// entries from there on are (0, 0) and never touch.
struct ContactBatch
{
  /// Contacts that are worked on together; sizes are multiples of it.
  static constexpr std::size_t block = 8;

  BatchLayout layout;
  std::vector<std::int32_t> a;         ///< particle
  std::vector<std::int32_t> b;         ///< particle, or row of the wall
  TripleColumn<double> shear, rolling; ///< springs, on A [N], [N m]
  /// Dashpots, force on A, last step [N]: read for the losses alone.
  TripleColumn<Narrow> dashpot;
  std::vector<ParticleLoad> load; ///< against walls: on the particle; 0 if open
  /// Particle against particle: where the load on B is added, see PairLoads.
  std::vector<std::int32_t> target;
  std::vector<double> overlap; ///< last; 0: open [m]
  /// Particle against particle: an open contact cannot touch before its
  /// particles have moved this far (both together), and is inactive till then
  /// [m].
  std::vector<double> reactivation;
  /// Elastic, last; where a linear contact has just ended < 0 [N]
  std::vector<double> normal_force;
  std::vector<double> shear_compliance;   ///< 1 / k_s, last [m/N]
  std::vector<double> rolling_compliance; ///< 1 / k_r, last [rad/(N m)]
  SideColumns side_a, side_b;
  /// Laws that scale with curvature, with sides: Prefactors [N/m^exponent]
  std::vector<double> normal_prefactor, shear_prefactor;
  std::vector<Narrow>
      torsion_angle; ///< turned about the normal since mixed [rad]
  /// Overlap that the contact had when it was found: it does not count [m]
  std::vector<double> overlap_offset;
  std::vector<std::uint8_t> displaced;    ///< has come to another contact point
  std::vector<double> factor_a, factor_b; ///< cumulative factors [-]
  /// A_i / delta of a corner that may break; 0: no corner (g = 0) [m]
  std::vector<Narrow> corner_a, corner_b;
  std::vector<Narrow> reversal; ///< reversal_of_energy [J]
  std::vector<double> peak; ///< of the counted energy, since there is one [J]
  /// Bit 0: side A breaks, bit 1: side B, bit 2: the contact began or ended.
  std::vector<std::uint8_t> event;
  /// Of laws that attract: energy of the normal spring [J], and the attraction
  /// that is part of `normal_force` [N], last.
  std::vector<double> normal_energy, attraction;
  std::vector<Narrow> reduced_radius; ///< Prefactors::radius, with sides [m]

  std::size_t size() const { return n; }
  /// Numbers of the contacts by (a, b), those of one pair by their directions
  /// on A: whatever order they stand in. Vacant entries are left out.
  std::vector<std::int32_t> by_pair() const;
  /// Puts some of them in that order.
  void sort_by_pair(std::span<std::int32_t> contacts) const;
  bool is_touching(std::size_t k) const { return overlap[k] > 0.; }
  /// Touches, or pulls across a gap.
  bool has_force(std::size_t k) const
  {
    return is_touching(k) || (layout.has_attraction && attraction[k] > 0.);
  }
  /// What presses: the elastic force without attraction [N].
  double pressing_force(std::size_t k) const
  {
    return layout.has_attraction ? normal_force[k] + attraction[k]
                                 : normal_force[k];
  }
  /// Tangent stiffness of the normal spring, which touches [N/m].
  double normal_stiffness(std::size_t k) const;

  /// Springs of contact k, as the last step left them.
  ContactHistory<double> history(std::size_t k) const;
  /// Energy in the springs of contact k [J].
  double stored_energy(std::size_t k) const;

  /// Takes the layout; entry k becomes entry source[k], or an empty one where
  /// that is negative.
  void rearrange(const BatchLayout &new_layout,
                 const std::vector<std::int32_t> &source);

  /// Some contacts, in this order.
  ContactBatch select(const std::vector<std::int32_t> &rows) const;
  /// `displaced` of a vacant entry.
  static constexpr std::uint8_t vacant = 255;
  /// Whether entry k waits for a new contact, of contacts that follow their
  /// surfaces: it has no springs, never touches and is in no list.
  bool is_vacant(std::size_t k) const
  {
    return layout.has_contact_points && displaced[k] == vacant;
  }
  std::size_t n_vacant() const;
  /// Entries that are not vacant.
  std::size_t n_contacts() const { return size() - n_vacant(); }
  /// Entry k loses all but its particles, and the surfaces that lanes beside it
  /// compute with.
  void vacate(std::size_t k);
  /// Entry k becomes an empty one between particles a and b.
  void start(std::size_t k, std::int32_t first, std::int32_t second);

  /// Adds contacts of the same layout at the end.
  void append(const ContactBatch &more);

  /// Contact k alone, and back again.
  ContactBatch extract(std::size_t k) const;
  void replace(std::size_t k, const ContactBatch &one);

  /// Calls call(is_there, columns...) for every column of some batches of one
  /// layout, in a fixed order; columns that the layout leaves out are empty.
  template <class Visit, class... Batches>
  static void visit(const BatchLayout &has, const Visit &call,
                    Batches &...batches);

  /// Zeros of contacts without a force lose their signs, which depend on the
  /// contacts that they were worked on with.
  void clear_signs_of_zeros();

  /// For restoring: the columns are set by hand.
  void set_size(std::size_t n_entries) { n = n_entries; }

private:
  std::size_t n = 0;
};

/// Calls call(contacts) with the numbers of all contacts of each pair of
/// particles.
template <class Call>
void for_each_pair(const ContactBatch &pairs, const Call &call)
{
  const std::vector<std::int32_t> order = pairs.by_pair();
  const auto key = [&](std::size_t row)
  {
    const auto k = static_cast<std::size_t>(order[row]);
    return std::pair(pairs.a[k], pairs.b[k]);
  };
  for (std::size_t first = 0, end = 0; first < order.size(); first = end)
  {
    for (end = first + 1; end < order.size() && key(end) == key(first);)
      ++end;
    call(std::span(order).subspan(first, end - first));
  }
}

template <class Visit, class... Batches>
void ContactBatch::visit(const BatchLayout &has, const Visit &call,
                         Batches &...batches)
{
  const bool has_two_sides = has.has_sides && has.has_partners;
  call(true, batches.a...);
  call(true, batches.b...);
  TripleColumn<double>::visit(call, true, batches.shear...);
  TripleColumn<double>::visit(call, has.has_rolling, batches.rolling...);
  TripleColumn<Narrow>::visit(call, true, batches.dashpot...);
  call(!has.has_partners, batches.load...);
  call(has.has_partners, batches.target...);
  call(true, batches.overlap...);
  call(has.has_partners, batches.reactivation...);
  call(true, batches.normal_force...);
  call(true, batches.shear_compliance...);
  call(has.has_rolling, batches.rolling_compliance...);
  SideColumns::visit(call, has, has.has_sides, batches.side_a...);
  SideColumns::visit(call, has, has_two_sides, batches.side_b...);
  call(has.has_prefactors, batches.normal_prefactor...);
  call(has.has_prefactors, batches.shear_prefactor...);
  call(has_two_sides, batches.torsion_angle...);
  call(has.has_contact_points, batches.overlap_offset...);
  call(has.has_contact_points, batches.displaced...);
  call(has.has_damage, batches.factor_a...);
  call(has.has_damage && has.has_partners, batches.factor_b...);
  call(has.has_damage, batches.corner_a...);
  call(has.has_damage && has.has_partners, batches.corner_b...);
  call(has.has_reversal, batches.reversal...);
  call(has.has_peak, batches.peak...);
  call(has.has_damage, batches.event...);
  call(has.has_attraction, batches.normal_energy...);
  call(has.has_attraction, batches.attraction...);
  call(has.has_attraction && has.has_sides, batches.reduced_radius...);
}
} // namespace dem
