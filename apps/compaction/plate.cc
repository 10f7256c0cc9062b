#include "compaction/plate.h"

#include "case/gravity.h"
#include "case/parameter.h"
#include "errors.h"

#include <dem/engine_boundaries.h>
#include <fem/disc_mesh.h>
#include <fem/drive.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace spall
{
namespace
{
/// Of the weight that particles need not carry yet when the guide goes [-].
constexpr double missing = 0.02;
/// No exciter starts then [s].
constexpr double never = 1e9;

/// A disc as wide as the container, its polygon round the circle.
fem::SolidMesh plate_mesh(const Case &c, double height)
{
  const PlateParameters &p = c.plate;
  const double radius = 0.5 * c.container.diameter;
  const auto cells = [&](double length)
  {
    return std::max(
        1, static_cast<int>(std::lround(length / radius * p.elements)));
  };
  const double within = std::min(p.load_radius, radius);
  fem::QuarterCylinder quarter;
  quarter.n_square = cells(0.55 * within);
  const double around =
      1. / std::cos(0.125 * std::numbers::pi / quarter.n_square);
  quarter.radius = within * around;
  const auto n_inner = static_cast<std::size_t>(cells(0.45 * within));
  quarter.inner.assign(n_inner, 1.);
  if (const double rest = radius - within; rest > 1e-9 * radius)
  {
    const auto n_outer = static_cast<std::size_t>(cells(rest));
    quarter.outer.assign(n_outer, rest * around / double(n_outer));
  }
  quarter.heights.assign(2, 0.5 * p.thickness);
  fem::SolidMesh mesh = fem::disc_mesh(quarter);
  for (Eigen::Vector3d &node : mesh.nodes)
    node.z() += height + p.thickness;
  return mesh;
}

/// Of a cell between a lower and an upper quad of the same shape [m^3].
double volume_of(const fem::SolidMesh &mesh, std::size_t cell)
{
  const auto at = [&](std::size_t corner) -> const Eigen::Vector3d &
  { return mesh.nodes[static_cast<std::size_t>(mesh.cells[cell][corner])]; };
  const Eigen::Vector3d area = 0.5 * (at(3) - at(0)).cross(at(2) - at(1));
  return std::abs(area.dot(at(4) - at(0)));
}

/// Layer 1 are the cells within the load radius; the volume of each layer
/// [m^3].
std::array<double, 2> mark_loaded(fem::SolidMesh &mesh, double load_radius)
{
  std::array<double, 2> volume{};
  for (std::size_t k = 0; k < mesh.cells.size(); ++k)
  {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const std::int32_t corner : mesh.cells[k])
      middle += 0.125 * mesh.nodes[static_cast<std::size_t>(corner)];
    mesh.layer[k] = middle.head<2>().norm() < load_radius ? 1 : 0;
    volume[static_cast<std::size_t>(mesh.layer[k])] += volume_of(mesh, k);
  }
  return volume;
}
} // namespace

coupling::RigidDrive plate_drive(const PlateParameters &plate,
                                 const VibrationParameters &v)
{
  const fem::Drive weight =
      fem::Drive::constant(-plate.mass * gravity - plate.load);
  const fem::Drive exciter = fem::Drive::eccentric_mass(
      {v.eccentric_mass * v.eccentricity, v.frequency, 0., plate.seating_time});
  coupling::RigidDrive drive;
  drive.load = [weight, exciter](double time)
  {
    fem::PlateLoad load;
    load.force.z() = weight(time) + exciter(time);
    return load;
  };
  return drive;
}

fem::Solid elastic_plate(const Case &c, double height)
{
  const PlateParameters &p = c.plate;
  fem::SolidMesh mesh = plate_mesh(c, height);
  const auto [bare, loaded] = mark_loaded(mesh, p.load_radius);
  const double own = p.density * (bare + loaded);
  if (own > p.mass)
    throw InputError(c.file + ": Plate/mass = " + number_text(p.mass) +
                     " kg: must be at least that of the elastic plate alone, " +
                     number_text(own) + " kg");
  const fem::SolidLayer steel{p.youngs_modulus, p.poisson_ratio, p.density};
  fem::SolidParameters body;
  body.layers = {steel, steel};
  body.layers[1].density += (p.mass - own) / loaded;
  fem::Solid plate(body, mesh);
  for (std::size_t k = 0; k < mesh.nodes.size(); ++k)
    if (mesh.nodes[k].head<2>().norm() < 1e-9 * c.container.diameter)
      plate.fix_node(static_cast<std::int32_t>(k), {true, true, false});
  return plate;
}

CompactionPlate::CompactionPlate(const Case &c, double height,
                                 std::size_t plane, coupling::Exchange &joined,
                                 dem::Engine &engine)
    : its_form(c.plate.form), plate(c.plate), vibration(c.vibration)
{
  start_exciter(never);
  if (its_form == PlateKind::rigid)
  {
    add_rigid({0., 0., height}, plane, joined, engine);
    return;
  }
  boundary = dem::surfaces(engine).size();
  const fem::SurfaceMesh face =
      fem::boundary_surface(plate_mesh(c, height), fem::z_lower).mesh;
  shares = fem::area_shares(face);
  std::unique_ptr<coupling::DeformableBody> made =
      its_form == PlateKind::tilting
          ? make_tilting(face, 0.5 * c.container.diameter)
          : make_elastic(elastic_plate(c, height), c.coupling);
  body = &joined.add(std::move(made), face, "plate", c.wall,
                     coupling::ParticleSide::outside, engine);
}

void CompactionPlate::add_rigid(const dem::Vec3 &position, std::size_t plane,
                                coupling::Exchange &joined, dem::Engine &engine)
{
  fem::PlateBodyParameters parameters;
  parameters.mass = plate.mass;
  parameters.centre = position;
  parameters.moves = {false, false, true};
  parameters.turns = {false, false, false};
  auto lid = std::make_unique<coupling::RigidBody>(
      parameters, coupling::Field{position},
      coupling::RigidDrive{[this](double time) { return drive.load(time); },
                           {}});
  body = lid.get();
  boundary = plane;
  shares = {1.};
  free_from = 0.;
  joined.add(std::move(lid), std::make_unique<coupling::PlaneAdapter>(plane),
             engine);
}

std::unique_ptr<coupling::DeformableBody>
CompactionPlate::make_tilting(const fem::SurfaceMesh &face, double radius)
{
  fem::PlateBodyParameters parameters;
  parameters.mass = plate.mass;
  parameters.inertia = fem::disc_inertia(plate.mass, radius, plate.height);
  parameters.centre = {0., 0., face.nodes[0].z() + 0.5 * plate.height};
  parameters.moves = {false, false, true};
  const double turning = parameters.inertia.minCoeff() / plate.mass;
  const auto load = [this, turning](double time)
  {
    fem::PlateLoad all;
    all.force.z() = force(time);
    if (time < free_from && rigid)
      all.moment = -guide() * turning * rigid->plate().spin();
    return all;
  };
  auto made = std::make_unique<coupling::RigidBody>(
      parameters, face.nodes, coupling::RigidDrive{load, {}});
  rigid = made.get();
  return made;
}

std::unique_ptr<coupling::DeformableBody>
CompactionPlate::make_elastic(fem::Solid disc, const CouplingParameters &c)
{
  std::vector<double> share(disc.nodal_mass().begin(), disc.nodal_mass().end());
  for (double &one : share)
    one /= plate.mass;
  auto made = std::make_unique<coupling::SolidBody>(
      std::move(disc), fem::z_lower,
      coupling::BodySteps{c.is_body_implicit, c.body_steps});
  solid = made.get();
  made->set_drive({[this](double time) { return force(time); }, share});
  return made;
}

void CompactionPlate::start_exciter(double time)
{
  PlateParameters seated = plate;
  seated.seating_time = time;
  drive = plate_drive(seated, vibration);
}

double CompactionPlate::weight() const
{
  return plate.mass * gravity + plate.load;
}

double CompactionPlate::guide() const
{
  return weight() / plate.seating_speed;
}

double CompactionPlate::force(double time) const
{
  if (time < free_from)
    return -weight() - guide() * velocity();
  return drive.load(time - free_from).force.z();
}

bool CompactionPlate::is_carried(const dem::Engine &engine) const
{
  return load(engine) >= (1. - missing) * weight();
}

namespace
{
double mean_z(std::span<const double> share, coupling::FieldView field)
{
  double sum = 0.;
  for (std::size_t k = 0; k < share.size(); ++k)
    sum += share[k] * field[k].z();
  return sum;
}
} // namespace

double CompactionPlate::height() const
{
  return mean_z(shares, body->motion().position);
}

/// 0 while it is being made.
double CompactionPlate::velocity() const
{
  if (const coupling::DeformableBody *present = solid ? solid : body)
    return mean_z(shares, present->motion().velocity);
  return 0.;
}

/// Slopes of the mean plane of a disc, which is round the z axis [-].
std::array<double, 2> CompactionPlate::slopes() const
{
  const coupling::FieldView position = body->motion().position;
  std::array<double, 2> slope{};
  for (int axis = 0; axis < 2; ++axis)
  {
    double rise = 0., square = 0.;
    for (std::size_t k = 0; k < shares.size(); ++k)
    {
      rise += shares[k] * position[k](axis) * position[k].z();
      square += shares[k] * position[k](axis) * position[k](axis);
    }
    slope[static_cast<std::size_t>(axis)] = square > 0. ? rise / square : 0.;
  }
  return slope;
}

double CompactionPlate::tilt() const
{
  const auto [x, y] = slopes();
  return std::atan(std::hypot(x, y));
}

double CompactionPlate::bending() const
{
  const auto [x, y] = slopes();
  double most = 0.;
  for (const dem::Vec3 &node : body->motion().position)
    most = std::max(
        most, std::abs(node.z() - height() - x * node.x() - y * node.y()));
  return most;
}

double CompactionPlate::load(const dem::Engine &engine) const
{
  if (!is_disc())
    return dem::planes(engine)[boundary].force.z();
  double sum = 0.;
  for (const dem::Vec3 &load :
       dem::facet_boundary(engine, boundary).surface.load)
    sum += load.z();
  return sum;
}

double CompactionPlate::impulse(const dem::Engine &engine) const
{
  if (!is_disc())
    return dem::planes(engine)[boundary].impulse.z();
  double sum = 0.;
  for (const dem::Vec3 &impulse : dem::facet_boundary(engine, boundary).impulse)
    sum += impulse.z();
  return sum;
}
} // namespace spall
