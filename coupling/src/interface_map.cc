#include <coupling/interface_map.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

namespace coupling
{
namespace
{
using Vector = Eigen::Vector3d;
using Quad = std::array<std::int32_t, 4>;

std::size_t index(std::int32_t number)
{
  return static_cast<std::size_t>(number);
}

/// A quarter of each corner.
Vector centre(std::span<const Vector> field, const Quad &quad)
{
  return 0.25 * ((field[index(quad[0])] + field[index(quad[1])]) +
                 (field[index(quad[2])] + field[index(quad[3])]));
}

/// Mass felt at a vertex that is the weighted mean of nodes: a force F there
/// moves it by F sum w^2 / m.
double effective_mass(double sum_over_mass)
{
  return sum_over_mass > 0. ? 1. / sum_over_mass
                            : std::numeric_limits<double>::infinity();
}

/// 0 / 0 is no error; anything else over 0 is infinite.
double relative(double error, double scale)
{
  return error == 0. ? 0. : error / scale;
}

/// Adds to the share of a node, which may be there already.
void add_share(std::array<dem::FarShare, 4> &shares, std::int32_t node,
               double weight)
{
  std::size_t slot = 0;
  while (shares[slot].body >= 0 && shares[slot].body != node)
    ++slot;
  shares[slot] = {node, shares[slot].weight + weight};
}

using Edge = std::pair<std::int32_t, std::int32_t>;

Edge edge(std::int32_t a, std::int32_t b)
{
  return std::minmax({a, b});
}
} // namespace

InterfaceMap::InterfaceMap(const fem::SurfaceMesh &mesh, ParticleSide side)
    : nodes(mesh.nodes.size()), quads(mesh.quads), midpoints(mesh.midpoints),
      ends(nodes, {-1, -1}), particles(side)
{
  for (const fem::SurfaceMesh::Midpoint &middle : midpoints)
    ends[index(middle.node)] = middle.ends;
}

std::vector<std::array<std::int32_t, 3>> InterfaceMap::triangles() const
{
  std::map<Edge, std::int32_t> middle_of;
  for (const fem::SurfaceMesh::Midpoint &middle : midpoints)
    middle_of[edge(middle.ends[0], middle.ends[1])] = middle.node;
  std::vector<std::array<std::int32_t, 3>> result;
  for (std::size_t k = 0; k < quads.size(); ++k)
  {
    const auto centre = static_cast<std::int32_t>(nodes + k);
    const auto add = [&](std::int32_t from, std::int32_t to)
    {
      if (particles == ParticleSide::outside)
        std::swap(from, to);
      result.push_back({from, to, centre});
    };
    for (std::size_t v = 0; v < 4; ++v)
    {
      const std::int32_t from = quads[k][v], to = quads[k][(v + 1) % 4];
      const auto middle = middle_of.find(edge(from, to));
      if (middle == middle_of.end())
        add(from, to);
      else
      {
        add(from, middle->second);
        add(middle->second, to);
      }
    }
  }
  return result;
}

dem::FacetSurface
InterfaceMap::make_surface(const NodeMotion &motion,
                           std::span<const double> nodal_mass) const
{
  dem::FacetSurface surface;
  surface.triangles = triangles();
  for (std::size_t k = 0; k < n_vertices(); ++k)
  {
    double over_mass = 0.;
    for (const dem::FarShare &share : shares(k))
      if (share.body >= 0)
        over_mass +=
            share.weight * share.weight / nodal_mass[index(share.body)];
    surface.mass.push_back(effective_mass(over_mass));
  }

  surface.position.resize(n_vertices());
  surface.velocity.resize(n_vertices());
  surface.load.assign(n_vertices(), Vector::Zero());
  send_motion(motion, surface);
  return surface;
}

void InterfaceMap::send_motion(const NodeMotion &motion,
                               dem::FacetSurface &surface) const
{
  const auto send = [this](FieldView of_nodes, Field &vertices)
  {
    std::copy_n(of_nodes.begin(), nodes, vertices.begin());
    for (const fem::SurfaceMesh::Midpoint &middle : midpoints)
      vertices[index(middle.node)] = 0.5 * (vertices[index(middle.ends[0])] +
                                            vertices[index(middle.ends[1])]);
    for (std::size_t k = 0; k < quads.size(); ++k)
      vertices[nodes + k] = centre(vertices, quads[k]);
  };
  send(motion.position, surface.position);
  send(motion.velocity, surface.velocity);
}

void InterfaceMap::collect(FieldView on_vertices, std::span<Vector> nodal) const
{
  std::copy_n(on_vertices.begin(), nodes, nodal.begin());
  for (std::size_t k = 0; k < quads.size(); ++k)
    for (const std::int32_t node : quads[k])
      nodal[index(node)] += 0.25 * on_vertices[nodes + k];
  for (const fem::SurfaceMesh::Midpoint &middle : midpoints)
  {
    for (const std::int32_t end : middle.ends)
      nodal[index(end)] += 0.5 * nodal[index(middle.node)];
    nodal[index(middle.node)] = Vector::Zero();
  }
}

std::array<dem::FarShare, 4> InterfaceMap::shares(std::size_t vertex) const
{
  std::array<dem::FarShare, 4> result;
  const auto add = [&](std::int32_t node, double weight)
  {
    if (ends[index(node)][0] < 0)
      add_share(result, node, weight);
    else
      for (const std::int32_t end : ends[index(node)])
        add_share(result, end, 0.5 * weight);
  };
  if (vertex < nodes)
    add(static_cast<std::int32_t>(vertex), 1.);
  else
    for (const std::int32_t node : quads[vertex - nodes])
      add(node, 0.25);
  return result;
}

void refer_to_nodes(std::span<const SurfacePoints> surfaces,
                    dem::SpringNetwork &springs)
{
  const std::size_t n_particles = springs.n_particles();
  springs.mass.resize(n_particles);
  // Where vertices and nodes of each surface begin among the bodies.
  std::vector<std::size_t> first_vertex{n_particles}, first_node;
  for (const SurfacePoints &surface : surfaces)
  {
    first_node.push_back(springs.mass.size());
    first_vertex.push_back(first_vertex.back() + surface.map->n_vertices());
    // The mass of a prescribed node is not used.
    for (const double mass : surface.nodal_mass)
      springs.mass.push_back(std::isinf(mass) ? 1. : mass);
  }
  for (auto &shares : springs.b)
  {
    const auto old = shares;
    if (old[0].body < 0 || index(old[0].body) < n_particles)
      continue;
    const auto after = std::upper_bound(first_vertex.begin(),
                                        first_vertex.end(), index(old[0].body));
    const auto s = static_cast<std::size_t>(after - first_vertex.begin()) - 1;
    shares = {};
    for (const dem::FarShare &of_vertex : old)
    {
      if (of_vertex.body < 0)
        continue;
      for (const dem::FarShare &of_node :
           surfaces[s].map->shares(index(of_vertex.body) - first_vertex[s]))
      {
        if (of_node.body < 0 ||
            std::isinf(surfaces[s].nodal_mass[index(of_node.body)]))
          continue;
        const auto body =
            static_cast<std::int32_t>(first_node[s]) + of_node.body;
        // The corners of a triangle lie in one quad: four nodes at most.
        add_share(shares, body, of_vertex.weight * of_node.weight);
      }
    }
  }
}

InterfaceBalance check_balance(const dem::FacetSurface &surface,
                               const NodeMotion &motion, FieldView nodal_load)
{
  if (nodal_load.size() != motion.position.size())
    throw std::invalid_argument(
        "interface balance: " + std::to_string(nodal_load.size()) +
        " loads for " + std::to_string(motion.position.size()) + " nodes");
  Vector force = Vector::Zero(), moment = Vector::Zero();
  double power = 0., force_scale = 0., moment_scale = 0., power_scale = 0.;
  for (std::size_t k = 0; k < surface.load.size(); ++k)
  {
    const Vector &load = surface.load[k];
    force -= load;
    moment -= surface.position[k].cross(load);
    power -= surface.velocity[k].dot(load);
    force_scale += load.norm();
    moment_scale += surface.position[k].norm() * load.norm();
    power_scale += surface.velocity[k].norm() * load.norm();
  }
  for (std::size_t k = 0; k < nodal_load.size(); ++k)
  {
    force += nodal_load[k];
    moment += motion.position[k].cross(nodal_load[k]);
    power += motion.velocity[k].dot(nodal_load[k]);
  }
  return {relative(force.norm(), force_scale),
          relative(moment.norm(), moment_scale),
          relative(std::abs(power), power_scale)};
}
} // namespace coupling
