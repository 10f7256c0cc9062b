#include "plastic_cells.h"

#include <map>

namespace fem
{
namespace
{
/// Of the elastic one, in Newton's matrix where the true one is zero: nodes
/// between such points alone would have none.
constexpr double apex_stiffness = 1e-3;

using CellVector = Eigen::Matrix<double, 24, 1>;

CellVector gather(std::span<const Eigen::Vector3d> u,
                  const std::array<std::int32_t, 8> &nodes)
{
  CellVector values;
  for (std::size_t v = 0; v < 8; ++v)
    values.segment<3>(3 * static_cast<Eigen::Index>(v)) =
        u[static_cast<std::size_t>(nodes[v])];
  return values;
}

VoigtMatrix elasticity(const DruckerPrager &law)
{
  return fem::elasticity(law.bulk_modulus, law.shear_modulus);
}
} // namespace

PlasticCells::PlasticCells(const SolidMesh &mesh,
                           std::span<const SolidLayer> layers)
    : entry(mesh.cells.size(), -1)
{
  for (const SolidLayer &layer : layers)
    laws.push_back(drucker_prager(
        layer.youngs_modulus, layer.poisson_ratio,
        {layer.cohesion, layer.friction_angle, layer.dilatancy_angle}));
  std::map<ShapeKey, std::size_t> known;
  for (std::size_t k = 0; k < mesh.cells.size(); ++k)
  {
    const auto layer = static_cast<std::size_t>(mesh.layer[k]);
    if (!layers[layer].yields())
      continue;
    const CellCorners corners = corners_of(mesh, k);
    const auto [shape, is_new] =
        known.emplace(shape_key(corners, mesh.layer[k]), shapes.size());
    if (is_new)
      shapes.push_back(mean_dilatation_points(corners));
    entry[k] = static_cast<std::int32_t>(cells.size());
    cells.push_back({k, mesh.cells[k], shape->second, layer});
  }
  initial.assign(8 * cells.size(), Voigt::Zero());
}

PlasticState PlasticCells::start() const
{
  const std::vector<Voigt> zeros(8 * cells.size(), Voigt::Zero());
  return {zeros, zeros};
}

void PlasticCells::set_initial_stress(
    const SolidMesh &mesh,
    const std::function<Voigt(const Eigen::Vector3d &)> &stress)
{
  initial.clear();
  for (const Cell &cell : cells)
    for (const Eigen::Vector3d &region :
         point_positions(corners_of(mesh, cell.number)))
      initial.push_back(stress(region));
}

void PlasticCells::add_initial_stress(std::span<const Voigt> stress)
{
  for (std::size_t at = 0; at < initial.size(); ++at)
    initial[at] += stress[at];
}

Voigt PlasticCells::elastic_trial(std::size_t cell, std::size_t point,
                                  const CellVector &u,
                                  const PlasticState &last) const
{
  const std::size_t at = 8 * cell + point;
  const Voigt strain = shapes[cells[cell].points].strain[point] * u;
  return initial[at] +
         elasticity(laws[cells[cell].law]) * (strain - last.strain[at]);
}

void PlasticCells::respond(std::span<const Eigen::Vector3d> u,
                           const PlasticState &last, PlasticState &next) const
{
  next.strain.resize(8 * cells.size());
  next.stress.resize(8 * cells.size());
  for (std::size_t k = 0; k < cells.size(); ++k)
  {
    const CellVector motion = gather(u, cells[k].nodes);
    const DruckerPrager &law = laws[cells[k].law];
    for (std::size_t q = 0; q < 8; ++q)
    {
      const std::size_t at = 8 * k + q;
      const Voigt trial = elastic_trial(k, q, motion, last);
      const ReturnedStress result = return_stress(law, trial);
      next.stress[at] = result.stress - initial[at];
      next.strain[at] = last.strain[at];
      if (result.region != YieldRegion::inside)
        next.strain[at] += elastic_strain(law, trial - result.stress);
    }
  }
}

void PlasticCells::relieve(const PlasticState &state,
                           std::span<Eigen::Vector3d> force) const
{
  for (std::size_t k = 0; k < cells.size(); ++k)
  {
    const CellPoints &points = shapes[cells[k].points];
    const VoigtMatrix c = elasticity(laws[cells[k].law]);
    CellVector more = CellVector::Zero();
    bool has_flown = false;
    for (std::size_t q = 0; q < 8; ++q)
    {
      const Voigt &plastic = state.strain[8 * k + q];
      if (plastic.isZero(0.))
        continue;
      has_flown = true;
      more += points.volume[q] * points.strain[q].transpose() * (c * plastic);
    }
    if (!has_flown)
      continue;
    for (std::size_t v = 0; v < 8; ++v)
      force[static_cast<std::size_t>(cells[k].nodes[v])] +=
          more.segment<3>(3 * static_cast<Eigen::Index>(v));
  }
}

void PlasticCells::soften(std::span<const Eigen::Vector3d> u,
                          const PlasticState &last,
                          std::vector<CellChange> &changes) const
{
  for (std::size_t k = 0; k < cells.size(); ++k)
  {
    const CellPoints &points = shapes[cells[k].points];
    const CellVector motion = gather(u, cells[k].nodes);
    const DruckerPrager &law = laws[cells[k].law];
    CellChange soft{cells[k].number, CellMatrix::Zero()};
    bool flows = false;
    for (std::size_t q = 0; q < 8; ++q)
    {
      const Voigt trial = elastic_trial(k, q, motion, last);
      const ReturnedStress stress = return_stress(law, trial);
      if (stress.region == YieldRegion::inside)
        continue;
      flows = true;
      const double kept =
          stress.region == YieldRegion::apex ? apex_stiffness : 0.;
      const VoigtMatrix change = consistent_tangent(law, trial, stress) -
                                 (1. - kept) * elasticity(law);
      soft.stiffness += points.volume[q] * points.strain[q].transpose() *
                        change * points.strain[q];
    }
    if (flows)
      changes.push_back(soft);
  }
}

double PlasticCells::stored_beyond(const PlasticState &state) const
{
  double sum = 0.;
  for (std::size_t k = 0; k < cells.size(); ++k)
    for (std::size_t q = 0; q < 8; ++q)
    {
      const std::size_t at = 8 * k + q;
      sum -= shapes[cells[k].points].volume[q] *
             (initial[at] + 0.5 * state.stress[at]).dot(state.strain[at]);
    }
  return sum;
}

double PlasticCells::dissipated(const PlasticState &last,
                                const PlasticState &next) const
{
  double sum = 0.;
  for (std::size_t k = 0; k < cells.size(); ++k)
    for (std::size_t q = 0; q < 8; ++q)
    {
      const std::size_t at = 8 * k + q;
      sum += shapes[cells[k].points].volume[q] *
             (initial[at] + 0.5 * (last.stress[at] + next.stress[at]))
                 .dot(next.strain[at] - last.strain[at]);
    }
  return sum;
}

double PlasticCells::yielded_share(const PlasticState &state) const
{
  double yielded = 0., whole = 0.;
  for (std::size_t k = 0; k < cells.size(); ++k)
    for (std::size_t q = 0; q < 8; ++q)
    {
      const double volume = shapes[cells[k].points].volume[q];
      whole += volume;
      if (!state.strain[8 * k + q].isZero(0.))
        yielded += volume;
    }
  return whole > 0. ? yielded / whole : 0.;
}

std::optional<Voigt> PlasticCells::mean_stress(std::size_t cell,
                                               const PlasticState &state) const
{
  if (entry[cell] < 0)
    return std::nullopt;
  const auto k = static_cast<std::size_t>(entry[cell]);
  const CellPoints &points = shapes[cells[k].points];
  Voigt sum = Voigt::Zero();
  double volume = 0.;
  for (std::size_t q = 0; q < 8; ++q)
  {
    sum += points.volume[q] * state.stress[8 * k + q];
    volume += points.volume[q];
  }
  return sum / volume;
}
} // namespace fem
