#include <coupling/exchange.h>
#include <dem/parallel/distribution.h>
#include <dem/parallel/rank_sums.h>

#include <array>
#include <cmath>
#include <span>
#include <utility>

// The stiffness of contacts in the implicit steps of bodies
// (docs/theory/windows.md).
namespace coupling
{
namespace
{
/// Twice what the mean load over the window gives way by, as its end moves.
Eigen::Matrix3d give(const ContactTangent &tangent, std::size_t k,
                     double window)
{
  return tangent.springs[k] + 2. / window * tangent.dashpots[k];
}

/// Entries of a symmetric matrix.
constexpr std::array<std::pair<int, int>, 6> triangle{
    {{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}}};

void add_triangle(const Eigen::Matrix3d &matrix, std::span<dem::ExactSum> sums)
{
  for (std::size_t e = 0; e < triangle.size(); ++e)
    sums[e].add(matrix(triangle[e].first, triangle[e].second));
}

Eigen::Matrix3d symmetric(std::span<const dem::ExactSum> sums)
{
  Eigen::Matrix3d matrix;
  for (std::size_t e = 0; e < triangle.size(); ++e)
  {
    const auto [row, column] = triangle[e];
    matrix(row, column) = matrix(column, row) = sums[e].value();
  }
  return matrix;
}
} // namespace

void ContactTangent::clear(std::size_t n_nodes)
{
  sums.assign(2 * triangle.size() * n_nodes, {});
}

void ContactTangent::add(std::size_t node, const Eigen::Matrix3d &spring,
                         const Eigen::Matrix3d &dashpot)
{
  const auto entries =
      std::span(sums).subspan(2 * triangle.size() * node, 2 * triangle.size());
  add_triangle(spring, entries);
  add_triangle(dashpot, entries.subspan(triangle.size()));
}

void ContactTangent::finish(const dem::Ranks &ranks)
{
  dem::sum_over_ranks(ranks, sums);
  springs.clear();
  dashpots.clear();
  for (std::size_t k = 0; k < sums.size(); k += 2 * triangle.size())
  {
    const auto entries = std::span<const dem::ExactSum>(sums).subspan(k);
    springs.push_back(symmetric(entries));
    dashpots.push_back(symmetric(entries.subspan(triangle.size())));
  }
}

/// Of the contacts that are there, on the nodes that take it and move freely;
/// false: there are none.
bool Exchange::find_tangent(CoupledBody &coupled, const dem::Engine &engine,
                            double window) const
{
  const std::size_t n = coupled.body->n_sprung();
  if (!parameters.has_contact_tangent || n == 0)
    return false;
  coupled.tangent.clear(coupled.at.size());
  coupled.adapter->add_tangent(engine, coupled.tangent);
  coupled.tangent.finish(engine.distribution().ranks());
  const std::vector<double> mass = coupled.body->nodal_mass();
  coupled.springs.stiffness.clear();
  for (std::size_t k = 0; k < n; ++k)
    coupled.springs.stiffness.push_back(std::isinf(mass[k])
                                            ? Eigen::Matrix3d::Zero()
                                            : give(coupled.tangent, k, window));
  return true;
}

/// The loads are means of the last window, in which nodes went from `from` to
/// where they are now; now they go from `at`.
void Exchange::predict_with_tangent(CoupledBody &coupled, double window) const
{
  const FieldView now = coupled.body->motion().position;
  const std::size_t n = coupled.springs.stiffness.size();
  Field load = coupled.load;
  coupled.springs.rest.assign(coupled.at.begin(),
                              coupled.at.begin() + std::ptrdiff_t(n));
  for (std::size_t k = 0; k < n; ++k)
    if (!coupled.springs.stiffness[k].isZero(0.))
    {
      const Eigen::Vector3d went = now[k] - coupled.from[k];
      load[k] +=
          0.5 * coupled.tangent.springs[k] *
              (coupled.from[k] - coupled.at[k] + now[k] - coupled.at[k]) +
          coupled.tangent.dashpots[k] * went / window;
    }
  coupled.body->advance(load, window, &coupled.springs);
}

/// Contact forces if the contacts had followed the body to where it
/// comes: its load then.
void Exchange::correct_with_tangent(CoupledBody &coupled, double window) const
{
  const std::size_t n = coupled.springs.stiffness.size();
  coupled.springs.rest.assign(coupled.target.begin(),
                              coupled.target.begin() + std::ptrdiff_t(n));
  coupled.body->advance(coupled.load, window, &coupled.springs);
  const FieldView now = coupled.body->motion().position;
  for (std::size_t k = 0; k < n; ++k)
    coupled.load[k] -=
        0.5 * coupled.springs.stiffness[k] * (now[k] - coupled.springs.rest[k]);
}
} // namespace coupling
