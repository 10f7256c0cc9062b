#include <dem/shape/cross_section.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <unordered_map>

namespace dem
{
namespace
{
using Vec2 = Eigen::Vector2d;
using Triangle = std::array<std::size_t, 3>;

constexpr int n_rings = 48;

/// The unit sphere as triangles between the nodes of a rule and its poles.
struct NodeSphere
{
  std::vector<Vec3> direction;     ///< of the nodes, then of both poles
  std::vector<Triangle> triangles; ///< counter-clockwise from outside
};

NodeSphere make_node_sphere()
{
  const SphereQuadrature &rule = sphere_rule(n_rings);
  NodeSphere sphere{rule.direction, {}};
  sphere.direction.push_back(-Vec3::UnitZ());
  sphere.direction.push_back(Vec3::UnitZ());
  const std::size_t n_azimuth = std::size_t(rule.n_azimuth),
                    n_nodes = rule.direction.size();
  const bool is_south_first = rule.ring_cosine.front() < 0.;
  for (std::size_t k = 0; k < n_azimuth; ++k)
  {
    const std::size_t next = (k + 1) % n_azimuth;
    for (std::size_t i = 0; i + 1 < std::size_t(rule.n_polar); ++i)
    {
      const std::size_t a = i * n_azimuth, b = a + n_azimuth;
      const std::size_t low = is_south_first ? a : b,
                        high = is_south_first ? b : a;
      sphere.triangles.push_back({low + k, low + next, high + next});
      sphere.triangles.push_back({low + k, high + next, high + k});
    }
    const std::size_t last = n_nodes - n_azimuth;
    const std::size_t south = is_south_first ? 0 : last,
                      north = is_south_first ? last : 0;
    sphere.triangles.push_back({south + next, south + k, n_nodes});
    sphere.triangles.push_back({north + k, north + next, n_nodes + 1});
  }
  return sphere;
}

const NodeSphere &node_sphere()
{
  static const NodeSphere sphere = make_node_sphere();
  return sphere;
}

/// A side of a triangle that the surface of the plane crosses, from the node
/// above it to the node below it.
struct CrossedSide
{
  std::size_t above = 0, below = 0;
};

std::uint64_t key_of(std::size_t a, std::size_t b)
{
  return (std::uint64_t(std::min(a, b)) << 32) | std::uint64_t(std::max(a, b));
}

/// Closed rows of crossed sides; what is above lies to the left from outside.
std::vector<std::vector<CrossedSide>>
crossed_rows(const std::vector<double> &excess)
{
  struct Step
  {
    CrossedSide side;
    std::uint64_t next = 0;
    bool is_done = false;
  };
  std::unordered_map<std::uint64_t, Step> steps;
  std::vector<std::uint64_t> starts;
  for (const Triangle &corners : node_sphere().triangles)
  {
    Step step;
    std::uint64_t from = 0;
    int n_crossed = 0;
    for (std::size_t c = 0; c < 3; ++c)
    {
      const std::size_t a = corners[c], b = corners[(c + 1) % 3];
      const bool is_a_above = excess[a] > 0., is_b_above = excess[b] > 0.;
      if (is_a_above == is_b_above)
        continue;
      ++n_crossed;
      if (is_a_above)
      {
        step.side = {a, b};
        from = key_of(a, b);
      }
      else
        step.next = key_of(a, b);
    }
    if (n_crossed == 0)
      continue;
    steps.emplace(from, step);
    starts.push_back(from);
  }
  std::vector<std::vector<CrossedSide>> rows;
  for (const std::uint64_t start : starts)
  {
    std::vector<CrossedSide> row;
    for (Step *step = &steps.at(start); !step->is_done;
         step = &steps.at(step->next))
    {
      step->is_done = true;
      row.push_back(step->side);
    }
    if (!row.empty())
      rows.push_back(std::move(row));
  }
  return rows;
}

/// Zeros of r(s) (s . n) - h along crossed sides, by Newton's method between
/// bounds.
class SideRoots
{
public:
  SideRoots(std::span<const double> its_series, const Vec3 &its_normal,
            double its_height)
      : series(its_series), normal(its_normal), height(its_height)
  {
  }

  /// Points of the surface, and its normals of any length, in the body frame.
  struct Points
  {
    std::vector<Vec3> point, normal; ///< [m]
  };

  Points points(const std::vector<CrossedSide> &row,
                const std::vector<double> &excess)
  {
    const std::size_t n = row.size();
    std::vector<double> at(n), low(n, 0.), high(n, 1.);
    for (std::size_t k = 0; k < n; ++k)
      at[k] =
          excess[row[k].above] / (excess[row[k].above] - excess[row[k].below]);
    constexpr int most_steps = 40; // halving alone ends within them
    for (int step = 0; step < most_steps; ++step)
    {
      set_shares(row, at);
      if (!refine(row, at, low, high))
        break;
    }
    set_shares(row, at);
    Points all;
    for (std::size_t k = 0; k < n; ++k)
    {
      all.point.push_back(expansion[k].radius * direction[k]);
      all.normal.push_back(all.point.back() - expansion[k].gradient);
    }
    return all;
  }

private:
  Vec3 chord(const CrossedSide &side) const
  {
    const std::vector<Vec3> &nodes = node_sphere().direction;
    return nodes[side.below] - nodes[side.above];
  }

  Vec3 on_chord(const CrossedSide &side, double share) const
  {
    return node_sphere().direction[side.above] + share * chord(side);
  }

  void set_shares(const std::vector<CrossedSide> &row,
                  const std::vector<double> &at)
  {
    direction.resize(row.size());
    expansion.resize(row.size());
    for (std::size_t k = 0; k < row.size(); ++k)
      direction[k] = on_chord(row[k], at[k]).normalized();
    expand(series, direction, expansion);
  }

  /// Whether any of them is still moving.
  bool refine(const std::vector<CrossedSide> &row, std::vector<double> &at,
              std::vector<double> &low, std::vector<double> &high) const
  {
    constexpr double tolerance = 1e-12; // of a side, some degrees [-]
    bool is_moving = false;
    for (std::size_t k = 0; k < row.size(); ++k)
    {
      const Vec3 &s = direction[k];
      const double r = expansion[k].radius,
                   length = on_chord(row[k], at[k]).norm();
      const Vec3 turn = (chord(row[k]) - chord(row[k]).dot(s) * s) / length;
      const double excess = r * s.dot(normal) - height,
                   slope = expansion[k].gradient.dot(turn) * s.dot(normal) +
                           r * turn.dot(normal);
      (excess > 0. ? low[k] : high[k]) = at[k];
      double next = slope < 0. ? at[k] - excess / slope : -1.;
      if (!(next > low[k] && next < high[k]) && excess != 0.)
        next = 0.5 * (low[k] + high[k]);
      if (excess == 0.)
        next = at[k];
      is_moving = is_moving || std::abs(next - at[k]) > tolerance;
      at[k] = next;
    }
    return is_moving;
  }

  std::span<const double> series;
  Vec3 normal;
  double height;
  std::vector<Vec3> direction;
  std::vector<RadialExpansion> expansion;
};

/// Area between a side of a polygon and a curve with these outward normals at
/// its ends: that of the cubic, L^2 (m_0 - m_1) / 12 with its slopes m to the
/// side. Zero where a slope is steep: the side is then far from the curve.
double bulge_of(const Vec2 &side, const Vec2 &first, const Vec2 &last)
{
  constexpr double steepest = 1.;
  const auto slope = [&](const Vec2 &normal) // of the outward offset
  {
    const double along = side.x() * normal.x() + side.y() * normal.y(),
                 across = side.y() * normal.x() - side.x() * normal.y();
    return across > 0. ? -along / across : 2. * steepest;
  };
  const double m0 = slope(first), m1 = slope(last);
  return std::max(std::abs(m0), std::abs(m1)) > steepest
             ? 0.
             : side.squaredNorm() * (m0 - m1) / 12.;
}

/// Unit direction in the body frame of a point of a plane.
Vec3 direction_to(const SectionPlane &plane, const Vec2 &point)
{
  return plane.rotation.transpose() *
         Vec3(point.x(), point.y(), plane.height).normalized();
}

/// First point of the body on the way from a point outside to `inner`; none if
/// there is none.
std::optional<Vec2> first_inside(const SectionedBody &body,
                                 const SectionPlane &plane, const Vec2 &from,
                                 const Vec2 &inner)
{
  const auto excess = [&](double share)
  {
    const Vec2 point = from + share * (inner - from);
    return std::hypot(point.norm(), plane.height) -
           body.radius_towards(plane, point);
  };
  const double length = (inner - from).norm();
  double outside = 0., inside = length > 0. ? excess(0.) / length : 1.;
  while (inside < 1. && excess(inside) > 0.)
  {
    outside = inside;
    inside *= 1.5;
  }
  if (inside >= 1.)
  {
    inside = 1.;
    if (excess(1.) > 0.)
      return {};
  }
  for (int k = 0; k < 40 && inside - outside > 1e-12; ++k)
  {
    const double middle = 0.5 * (outside + inside);
    (excess(middle) > 0. ? outside : inside) = middle;
  }
  return from + inside * (inner - from);
}

/// A polygon of the section before, whose corners are followed to the surface
/// after.
class OutlineLoss
{
public:
  OutlineLoss(const SectionLoop &loop, const SectionedBody &its_body,
              const SectionPlane &its_plane)
      : outline(loop.corners), body(its_body), plane(its_plane),
        centroid(polygon_centroid(outline)), area(loop.area)
  {
    for (const Vec2 &corner : outline)
      depth.push_back(std::hypot(corner.norm(), plane.height) -
                      body.radius_towards(plane, corner));
  }

  double largest_depth() const { return std::ranges::max(depth); }

  void add_regions(double least_depth, std::vector<Polygon> &regions) const
  {
    const std::size_t n = outline.size();
    const auto kept = std::ranges::find_if(depth, [&](double one)
                                           { return one <= least_depth; });
    if (kept == depth.end())
      return regions.push_back(ring());
    const auto start = std::size_t(std::distance(depth.begin(), kept));
    for (std::size_t step = 0; step < n;)
    {
      const std::size_t from = (start + step) % n;
      std::size_t n_lost = 0;
      while (step + n_lost + 1 < n &&
             depth[(from + n_lost + 1) % n] > least_depth)
        ++n_lost;
      if (n_lost > 0)
        regions.push_back(arc(from, n_lost));
      step += n_lost + 1;
    }
  }

private:
  /// The first point inside from a corner along the inward normal, which lies
  /// to the left of the outline, also of a hole: where the outline is concave
  /// the centroid may lie on the other side. What has vanished shrinks to it.
  Vec2 inner_end(std::size_t k) const
  {
    const std::size_t n = outline.size();
    const Vec2 along = outline[(k + 1) % n] - outline[(k + n - 1) % n];
    const Vec2 end = outline[k] + std::sqrt(std::abs(area)) *
                                      Vec2(-along.y(), along.x()).normalized();
    const std::optional<Vec2> inside =
        first_inside(body, plane, outline[k], end);
    return inside ? *inside : area > 0. ? centroid : end;
  }

  /// From corner `from`, over so many that have lost, to the next one.
  Polygon arc(std::size_t from, std::size_t n_lost) const
  {
    const std::size_t n = outline.size();
    Polygon region;
    for (std::size_t k = 0; k < n_lost + 2; ++k)
      region.push_back(outline[(from + k) % n]);
    for (std::size_t k = n_lost; k > 0; --k)
      region.push_back(inner_end((from + k) % n));
    return region;
  }

  /// All round, with a cut of no width from outside to inside.
  Polygon ring() const
  {
    Polygon region = outline;
    region.push_back(outline[0]);
    for (std::size_t k = outline.size() + 1; k > 0; --k)
      region.push_back(inner_end((k - 1) % outline.size()));
    return region;
  }

  const Polygon &outline;
  const SectionedBody &body;
  const SectionPlane &plane;
  Vec2 centroid;
  double area;               ///< [m^2]
  std::vector<double> depth; ///< radius lost at each corner [m]
};
} // namespace

SectionedBody::SectionedBody(std::span<const double> its_series,
                             double its_scale)
    : series(its_series), scale(its_scale)
{
  std::vector<double> radii = node_radii(series, sphere_rule(n_rings));
  const std::vector<Vec3> &nodes = node_sphere().direction;
  for (std::size_t k = radii.size(); k < nodes.size(); ++k)
    radii.push_back(dem::radius(series, nodes[k]));
  node_radius = std::make_shared<const std::vector<double>>(std::move(radii));
}

SectionedBody SectionedBody::at_scale(double other) const
{
  SectionedBody body = *this;
  body.scale = other;
  return body;
}

std::vector<SectionLoop> SectionedBody::section(const SectionPlane &plane) const
{
  // Seen from the origin the section is round the nearer pole of the plane.
  const double side = plane.height < 0. ? -1. : 1.;
  const Vec3 normal = side * plane.rotation.row(2).transpose();
  const double height = side * plane.height / scale;
  const std::vector<Vec3> &nodes = node_sphere().direction;
  std::vector<double> excess(nodes.size());
  for (std::size_t k = 0; k < nodes.size(); ++k)
    excess[k] = (*node_radius)[k] * nodes[k].dot(normal) - height;
  SideRoots roots(series, normal, height);
  std::vector<SectionLoop> loops;
  for (const std::vector<CrossedSide> &row : crossed_rows(excess))
  {
    SideRoots::Points found = roots.points(row, excess);
    if (side < 0.)
    {
      std::ranges::reverse(found.point);
      std::ranges::reverse(found.normal);
    }
    const auto in_plane = [&](const Vec3 &vector)
    { return Vec2(scale * (plane.rotation * vector).head<2>()); };
    SectionLoop loop;
    for (const Vec3 &point : found.point)
      loop.corners.push_back(in_plane(point));
    loop.area = polygon_area(loop.corners);
    for (std::size_t k = 0; k < row.size(); ++k)
    {
      const std::size_t next = (k + 1) % row.size();
      loop.area +=
          bulge_of(loop.corners[next] - loop.corners[k],
                   in_plane(found.normal[k]), in_plane(found.normal[next]));
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

double section_area(std::span<const SectionLoop> section)
{
  double area = 0.;
  for (const SectionLoop &loop : section)
    area += loop.area;
  return area;
}

double SectionedBody::radius_towards(const SectionPlane &plane,
                                     const Vec2 &point) const
{
  return scale * dem::radius(series, direction_to(plane, point));
}

LostRegions lost_regions(const SectionedBody &before,
                         const SectionedBody &after, const SectionPlane &plane,
                         double least_depth)
{
  LostRegions lost;
  for (const SectionLoop &loop : before.section(plane))
  {
    const OutlineLoss loss(loop, after, plane);
    lost.depth = std::max(lost.depth, loss.largest_depth());
    lost.area_before += loop.area;
    loss.add_regions(least_depth, lost.regions);
  }
  return lost;
}
} // namespace dem
