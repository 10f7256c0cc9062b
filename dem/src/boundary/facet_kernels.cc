// Compiled once per instruction set, with SPALL_INSTRUCTION_SET its name.
#include "facet_kernels.h"

#include "../contact/simd_surface.h"

#include <cstring>

namespace dem::kernel
{
namespace
{
/// No deeper than this part of the radius.
constexpr double deepest = 0.3;
/// Least eigenvalue of I - delta K [-] and of the curvature of the depth, over
/// the radius [-]: as the search takes them without raising them.
constexpr double least_system = 0.3, least_hill = 0.009;
/// A contact point this near to a side may be on the next triangle [-].
constexpr double least_weight = 1e-9;
/// Cosine between the normals of contact and triangle from where on the
/// triangle faces the particle.
constexpr double least_facing = 0.7;

Simd length_of(const SimdVector &v)
{
  return stdx::sqrt(dot(v, v));
}

/// Smallest eigenvalue above `least`.
SimdMask is_above(const SimdMatrix &m, const Simd &least)
{
  const Simd x = m.xx - least, y = m.yy - least;
  return x > 0. && x * y - m.xy * m.xy > 0.;
}

/// Contacts in lanes; those past the end stand for the last.
struct LaneContacts
{
  std::int64_t number[n_lanes];

  LaneContacts(std::int64_t first, int n)
  {
    for (int lane = 0; lane < n_lanes; ++lane)
      number[lane] = first + (lane < n ? lane : n - 1);
  }
  std::int64_t operator[](int lane) const { return number[lane]; }
  Simd of(const double *column) const
  {
    return Simd([this, column](auto lane) { return column[number[lane]]; });
  }
};

/// Three vectors of vertices, or three numbers.
struct LaneCorners
{
  std::int32_t vertex[3][n_lanes];

  LaneCorners(const FacetTask &task, const std::int32_t *triangle)
  {
    for (int lane = 0; lane < n_lanes; ++lane)
      for (int c = 0; c < 3; ++c)
        vertex[c][lane] = task.corner[3 * std::int64_t{triangle[lane]} + c];
  }
  Simd number(int c, const double *column) const
  {
    return Simd([this, c, column](auto lane)
                { return column[vertex[c][lane]]; });
  }
  SimdVector vector(int c, const double *column) const
  {
    return vectors_at(vertex[c], column);
  }
  static SimdVector vectors_at(const std::int32_t *vertices,
                               const double *column)
  {
    const auto component = [vertices, column](int d)
    {
      return Simd([vertices, column, d](auto lane)
                  { return column[3 * std::int64_t{vertices[lane]} + d]; });
    };
    return {component(0), component(1), component(2)};
  }
};

/// Barycentric weights of the corners, or steps of them.
struct LaneWeights
{
  Simd of[3];

  SimdVector mean(const SimdVector *vector) const
  {
    return of[0] * vector[0] + of[1] * vector[1] + of[2] * vector[2];
  }
};

/// The triangle of every contact, as it stands now.
struct LaneTriangles
{
  std::int32_t triangle[n_lanes];
  SimdMask is_known = SimdMask(true);
  LaneWeights weight; ///< of the contact in the last step
  SimdVector normal_before;

  LaneTriangles(const FacetTask &task, const LaneContacts &contact)
  {
    for (int lane = 0; lane < n_lanes; ++lane)
    {
      std::int64_t number;
      std::memcpy(&number, task.points + facet_point_row * contact[lane],
                  sizeof number);
      is_known[static_cast<std::size_t>(lane)] = number >= 0;
      triangle[lane] = number >= 0 ? static_cast<std::int32_t>(number) : 0;
    }
    const SimdRows<facet_point_row> row(task.points, contact);
    const SimdVector w = row.vector(at_weight);
    weight = {{w.x, w.y, w.z}};
    normal_before = row.vector(at_facet_normal);
  }
};

/// Depth D(y + z) of the points about y in the particle, to second order: with
/// n the normal at the point next to y, D - n.z - z.C z / 2.
struct LaneDepth
{
  SimdSurface on_a;
  SimdFrame frame;   ///< two tangents at the contact in the last step
  SimdVector before; ///< normal there
  SimdMatrix follow; ///< (I - delta K)^-1
  SimdMatrix hill;   ///< C
  SimdPlanar step;   ///< to the point next to y
  Simd overlap;      ///< D(y)
  SimdVector normal; ///< n; its length is one to first order
  SimdMask is_sound;

  /// Normal where the point of the particle is a step on.
  SimdVector normal_at(const SimdPlanar &on_particle) const
  {
    return before + frame.in_world(on_a.shape_operator * on_particle);
  }
};

/// (I - delta K) a = -t, D(y) = delta + a.K t / 2.
LaneDepth depth_at(const FacetTask &task, std::int64_t k,
                   const ParticleSimd &particle, const SimdVector &y)
{
  LaneDepth at;
  at.on_a = locate_surface(task.side, k, particle);
  const SimdVector apart = particle.vector(at_position) + at.on_a.arm - y;
  at.frame = {at.on_a.frame.first - at.on_a.turn.x * at.on_a.axis,
              at.on_a.frame.second - at.on_a.turn.y * at.on_a.axis};
  at.before = at.on_a.inverse_length() * at.on_a.outward();
  const SimdMatrix &curvature = at.on_a.shape_operator;
  const Simd delta = dot(apart, at.before);
  const SimdPlanar aside = in_frame(at.frame, apart);
  const SimdMatrix system{1. - delta * curvature.xx, -delta * curvature.xy,
                          1. - delta * curvature.yy};
  at.is_sound = is_above(system, Simd(least_system)) && at.on_a.height > 0.;
  const Simd inverse = 1. / select(at.is_sound, system.determinant(), Simd(1.));
  at.follow = {inverse * system.yy, -inverse * system.xy, inverse * system.xx};
  const SimdPlanar back = at.follow * aside;
  at.step = {-back.x, -back.y};
  at.overlap = delta + 0.5 * dot(at.step, curvature * aside);
  // K and (I - delta K)^-1 commute.
  at.hill = {curvature.xx * at.follow.xx + curvature.xy * at.follow.xy,
             curvature.xx * at.follow.xy + curvature.xy * at.follow.yy,
             curvature.xy * at.follow.xy + curvature.yy * at.follow.yy};
  at.is_sound =
      at.is_sound &&
      is_above(at.hill,
               least_hill / select(at.is_sound, at.on_a.height, Simd(1.)));
  at.normal = at.normal_at(at.step);
  return at;
}

/// A step along the triangle or along the side that a contact is on.
struct LaneClimb
{
  LaneWeights weight; ///< there
  SimdPlanar across;  ///< its part across the normal
  Simd gain;          ///< of depth
  SimdMask is_sound;
};

/// The side that a contact is on: across from the corner of weight zero.
struct LaneSide
{
  Simd n_zero = Simd(0.); ///< corners without weight: 1 on a side
  LaneWeights along;      ///< a step along the side, from end to end

  explicit LaneSide(const LaneWeights &weight)
  {
    for (Simd &step : along.of)
      step = Simd(0.);
    for (int c = 0; c < 3; ++c)
    {
      const Simd is_zero = select(weight.of[c] > 0., Simd(0.), Simd(1.));
      n_zero += is_zero;
      along.of[(c + 1) % 3] -= is_zero;
      along.of[(c + 2) % 3] += is_zero;
    }
  }
  SimdMask is_there() const { return n_zero == 1.; }
};

/// Up the depth as far as it grows by the model.
LaneClimb climb(const LaneDepth &depth, const LaneTriangles &at,
                const LaneSide &side, const SimdVector *corner)
{
  const SimdVector first = corner[1] - corner[0],
                   second = corner[2] - corner[0];
  const SimdPlanar p = in_frame(depth.frame, first),
                   q = in_frame(depth.frame, second);
  const Simd slope_p = -dot(depth.normal, first),
             slope_q = -dot(depth.normal, second);
  const SimdPlanar bent_p = depth.hill * p, bent_q = depth.hill * q;
  const SimdMatrix hill{dot(p, bent_p), dot(q, bent_p), dot(q, bent_q)};
  // On the face.
  const Simd determinant = hill.determinant();
  SimdMask is_sound = hill.xx > 0. && determinant > 0.;
  const Simd inverse = 1. / select(is_sound, determinant, Simd(1.));
  Simd to_second = inverse * (hill.yy * slope_p - hill.xy * slope_q),
       to_third = inverse * (hill.xx * slope_q - hill.xy * slope_p);
  // On a side.
  const SimdMask is_on_side = side.is_there();
  if (any(is_on_side))
  {
    const Simd &b = side.along.of[1], &c = side.along.of[2];
    const Simd slope = b * slope_p + c * slope_q,
               curvature =
                   b * b * hill.xx + 2. * b * c * hill.xy + c * c * hill.yy;
    const SimdMask is_hill = curvature > 0.;
    const Simd s = slope / select(is_hill, curvature, Simd(1.));
    to_second = select(is_on_side, s * b, to_second);
    to_third = select(is_on_side, s * c, to_third);
    is_sound = (is_on_side && is_hill) || (!is_on_side && is_sound);
  }
  LaneClimb step;
  step.weight = {{at.weight.of[0] - to_second - to_third,
                  at.weight.of[1] + to_second, at.weight.of[2] + to_third}};
  step.across = {to_second * p.x + to_third * q.x,
                 to_second * p.y + to_third * q.y};
  step.gain = 0.5 * (to_second * slope_p + to_third * slope_q);
  step.is_sound = is_sound && side.n_zero < 2.;
  for (int c = 0; c < 3; ++c)
  {
    const SimdMask has_weight = at.weight.of[c] > 0.;
    step.weight.of[c] = select(has_weight, step.weight.of[c], Simd(0.));
    step.is_sound =
        step.is_sound && (!has_weight || step.weight.of[c] > least_weight);
  }
  return step;
}

/// Whether the depth falls off from a side into the triangle with this third
/// corner.
SimdMask falls_off(const SimdVector &normal, const SimdVector &start,
                   const SimdVector &along, const SimdVector &third)
{
  const SimdVector out = third - start;
  const SimdVector into = out - dot(out, along) / dot(along, along) * along;
  return dot(normal, into) >= 0.;
}

/// Corner without weight of a contact on a side.
int corner_across(const LaneWeights &weight, std::size_t lane)
{
  return weight.of[0][lane] <= 0. ? 0 : weight.of[1][lane] <= 0. ? 1 : 2;
}

/// Whether contacts on a side stay on it.
SimdMask stays_on_side(const FacetTask &task, const LaneTriangles &at,
                       const LaneCorners &corners, const SimdVector &normal)
{
  // The ends of the side, the corner across, and that of the next triangle; at
  // a rim there is none.
  std::int32_t start[n_lanes], end[n_lanes], third[n_lanes], beyond[n_lanes];
  for (int lane = 0; lane < n_lanes; ++lane)
  {
    const int c = corner_across(at.weight, static_cast<std::size_t>(lane)),
              from = (c + 1) % 3, to = (c + 2) % 3;
    start[lane] = corners.vertex[from][lane];
    end[lane] = corners.vertex[to][lane];
    beyond[lane] = third[lane] = corners.vertex[c][lane];
    const std::int64_t next =
        task.neighbour[3 * std::int64_t{at.triangle[lane]} + from];
    if (next >= 0)
    {
      const std::int32_t *vertex = task.corner + 3 * next;
      beyond[lane] =
          vertex[0] + vertex[1] + vertex[2] - start[lane] - end[lane];
    }
  }
  const auto position = [&task](const std::int32_t *vertices)
  { return LaneCorners::vectors_at(vertices, task.position); };
  const SimdVector from = position(start), along = position(end) - from;
  return falls_off(normal, from, along, position(third)) &&
         falls_off(normal, from, along, position(beyond));
}

/// Path lengths of particle and surface.
Simd contact_paths(const FacetTask &task, std::int64_t k)
{
  return Simd([&task, k](auto lane)
              { return task.particle_path[task.a[k + lane]]; }) +
         task.surface_path;
}

/// Writes the rows of the contacts that were followed.
void store_contacts(const FacetTask &task, const LaneContacts &contact,
                    const SimdMask &is_followed, const SimdTable<16> &wall,
                    const SimdTable<8> &point)
{
  for (int lane = 0; lane < n_lanes; ++lane)
  {
    if (!is_followed[static_cast<std::size_t>(lane)])
      continue;
    std::memcpy(task.rows + wall_row * contact[lane], wall.value[lane],
                sizeof wall.value[lane]);
    std::memcpy(task.points + facet_point_row * contact[lane] + at_weight,
                point.value[lane], 6 * sizeof(double));
  }
}

/// The contacts that have a step which holds, with the others lost.
SimdMask follow(const FacetTask &task, std::int64_t k,
                const LaneContacts &contact, const SimdMask &is_due,
                double tolerance, SimdMask &is_stale)
{
  const LaneTriangles at(task, contact);
  const LaneCorners corners(task, at.triangle);
  SimdVector corner[3], velocity[3];
  for (int c = 0; c < 3; ++c)
  {
    corner[c] = corners.vector(c, task.position);
    velocity[c] = corners.vector(c, task.velocity);
  }
  const ParticleSimd particle(task.particles, task.a + k);
  const LaneDepth depth = depth_at(task, k, particle, at.weight.mean(corner));
  const LaneSide side(at.weight);
  const LaneClimb climbed = climb(depth, at, side, corner);
  const SimdPlanar further = depth.follow * climbed.across;
  const SimdPlanar step{depth.step.x + further.x, depth.step.y + further.y};
  const SimdVector outward = depth.normal_at(step);
  const SimdVector normal = 1. / length_of(outward) * outward;
  const Simd overlap = depth.overlap + climbed.gain;
  const SimdVector area = cross(corner[1] - corner[0], corner[2] - corner[0]);
  SimdMask is_followed = is_due && at.is_known && depth.is_sound &&
                         climbed.is_sound &&
                         is_short(step, depth.on_a.height) &&
                         is_short(climbed.across, depth.on_a.height) &&
                         overlap < deepest * depth.on_a.height &&
                         dot(normal, area) > least_facing * length_of(area);
  if (any(side.is_there() && is_followed))
    is_followed = is_followed && (!side.is_there() ||
                                  stays_on_side(task, at, corners, normal));
  if (!any(is_followed))
    return is_followed;

  const SimdVector y = climbed.weight.mean(corner);
  const SimdVector now = climbed.weight.mean(velocity),
                   before = at.weight.mean(velocity);
  Simd inverse_mass(0.);
  for (int c = 0; c < 3; ++c)
    inverse_mass += climbed.weight.of[c] * climbed.weight.of[c] /
                    corners.number(c, task.mass);
  SimdTable<16> wall;
  wall.set(0, {y, normal.x});
  wall.set(4, {{normal.y, normal.z, now.x}, now.y});
  wall.set(8, {{now.z, before.x, before.y}, before.z});
  wall.set(12, {at.normal_before, inverse_mass});
  SimdTable<8> point;
  point.set(0,
            {{climbed.weight.of[0], climbed.weight.of[1], climbed.weight.of[2]},
             normal.x});
  point.set(4, {{normal.y, normal.z, Simd(0.)}});
  store_contacts(task, contact, is_followed, wall, point);
  const SimdMask rests = load(task.overlap + k) <= 0. &&
                         overlap < -least_resting_gap * depth.on_a.height;
  const Simd path = contact_paths(task, k);
  for (int lane = 0; lane < n_lanes; ++lane)
    if (const auto l = static_cast<std::size_t>(lane); is_followed[l])
    {
      const std::int64_t at_contact = contact[lane];
      task.depth[at_contact] = overlap[l];
      task.reactivation[at_contact] = rests[l] ? path[l] - overlap[l] : 0.;
    }
  is_stale =
      move_on_surface(task.side, k, depth.on_a, step, is_followed, tolerance);
  return is_followed;
}

unsigned bits_of(const SimdMask &mask)
{
  unsigned bits = 0;
  for (int lane = 0; lane < n_lanes; ++lane)
    bits |= static_cast<unsigned>(mask[static_cast<std::size_t>(lane)]) << lane;
  return bits;
}

FacetBlock follow_block(const FacetTask &task, std::int64_t first, int n,
                        double tolerance)
{
  FacetBlock block;
  for (int from = 0; from < n; from += n_lanes)
  {
    const std::int64_t k = first + from;
    const int n_valid = n - from < n_lanes ? n - from : n_lanes;
    const LaneContacts contact(k, n_valid);
    const SimdMask is_touching = load(task.overlap + k) > 0.;
    const SimdMask is_closed = load(task.overlap_offset + k) >= closed_offset;
    const SimdMask is_due =
        valid_lanes(n_valid) &&
        contact_paths(task, k) >= contact.of(task.reactivation) &&
        (!is_closed || is_touching);
    for (int lane = 0; lane < n_valid; ++lane)
      task.depth[k + lane] = 0.;
    if (!any(is_due))
      continue;
    SimdMask is_stale(false);
    const SimdMask is_followed =
        follow(task, k, contact, is_due && !is_closed, tolerance, is_stale);
    block.is_lost |= bits_of(is_due && !is_followed) << from;
    block.is_stale |= bits_of(is_stale) << from;
  }
  return block;
}
} // namespace

namespace SPALL_INSTRUCTION_SET
{
extern const FollowFacets follow_facets;
const FollowFacets follow_facets = follow_block;
} // namespace SPALL_INSTRUCTION_SET
} // namespace dem::kernel
