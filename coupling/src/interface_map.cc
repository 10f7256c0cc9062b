#include <coupling/interface_map.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

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
} // namespace

InterfaceMap::InterfaceMap(const fem::Membrane &membrane)
    : n_nodes(membrane.n_nodes()), quads(membrane.mesh().quads)
{
}

dem::FacetSurface
InterfaceMap::make_surface(const fem::Membrane &membrane) const
{
  dem::FacetSurface surface;
  const std::size_t n_vertices = n_nodes + quads.size();
  for (std::size_t k = 0; k < quads.size(); ++k)
    for (std::size_t v = 0; v < 4; ++v)
      surface.triangles.push_back({quads[k][v], quads[k][(v + 1) % 4],
                                   static_cast<std::int32_t>(n_nodes + k)});

  std::vector<double> over_mass(n_vertices, 0.);
  for (std::size_t k = 0; k < n_nodes; ++k)
    if (!membrane.is_tied(static_cast<std::int32_t>(k)))
      over_mass[k] = 1. / membrane.nodal_mass()[k];
  for (std::size_t k = 0; k < quads.size(); ++k)
    for (const std::int32_t node : quads[k])
      over_mass[n_nodes + k] += over_mass[index(node)] / 16.;
  for (const double entry : over_mass)
    surface.mass.push_back(effective_mass(entry));

  surface.position.resize(n_vertices);
  surface.velocity.resize(n_vertices);
  surface.load.assign(n_vertices, Vector::Zero());
  send_motion(membrane, surface);
  return surface;
}

void InterfaceMap::send_motion(const fem::Membrane &membrane,
                               dem::FacetSurface &surface) const
{
  const auto send =
      [this](std::span<const Vector> nodes, std::vector<Vector> &vertices)
  {
    std::copy(nodes.begin(), nodes.end(), vertices.begin());
    for (std::size_t k = 0; k < quads.size(); ++k)
      vertices[n_nodes + k] = centre(nodes, quads[k]);
  };
  send(membrane.positions(), surface.position);
  send(membrane.velocities(), surface.velocity);
}

void InterfaceMap::collect_load(const dem::FacetSurface &surface,
                                std::vector<Vector> &nodal_load) const
{
  nodal_load.assign(surface.load.begin(),
                    surface.load.begin() +
                        static_cast<std::ptrdiff_t>(n_nodes));
  for (std::size_t k = 0; k < quads.size(); ++k)
    for (const std::int32_t node : quads[k])
      nodal_load[index(node)] += 0.25 * surface.load[n_nodes + k];
}

void InterfaceMap::refer_to_nodes(const fem::Membrane &membrane,
                                  dem::SpringNetwork &springs) const
{
  const std::size_t n_stones = springs.n_stones();
  springs.mass.resize(n_stones);
  springs.mass.insert(springs.mass.end(), membrane.nodal_mass().begin(),
                      membrane.nodal_mass().end());
  for (auto &shares : springs.b)
  {
    const auto old = shares;
    if (old[0].body < 0 || index(old[0].body) < n_stones)
      continue;
    shares = {};
    std::size_t n_shares = 0;
    const auto add = [&](std::int32_t node, double weight)
    {
      if (membrane.is_tied(node))
        return;
      const auto body = static_cast<std::int32_t>(n_stones) + node;
      std::size_t place = 0;
      while (place < n_shares && shares[place].body != body)
        ++place;
      // The corners of a triangle lie in one quad: four nodes at most.
      n_shares = std::max(n_shares, place + 1);
      shares[place] = {body, shares[place].weight + weight};
    };
    for (const dem::FarShare &share : old)
    {
      if (share.body < 0)
        continue;
      const std::size_t vertex = index(share.body) - n_stones;
      if (vertex < n_nodes)
        add(static_cast<std::int32_t>(vertex), share.weight);
      else
        for (const std::int32_t node : quads[vertex - n_nodes])
          add(node, 0.25 * share.weight);
    }
  }
}

InterfaceBalance check_balance(const dem::FacetSurface &surface,
                               const fem::Membrane &membrane,
                               std::span<const Vector> nodal_load)
{
  if (nodal_load.size() != membrane.n_nodes())
    throw std::invalid_argument(
        "interface balance: " + std::to_string(nodal_load.size()) +
        " loads for " + std::to_string(membrane.n_nodes()) + " nodes");
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
    moment += membrane.positions()[k].cross(nodal_load[k]);
    power += membrane.velocities()[k].dot(nodal_load[k]);
  }
  return {relative(force.norm(), force_scale),
          relative(moment.norm(), moment_scale),
          relative(std::abs(power), power_scale)};
}
} // namespace coupling
