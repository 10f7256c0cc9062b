#pragma once

#include <dem/parameters/material.h>
#include <dem/shape/spherical_harmonics.h>

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace spall
{
/// The particles of a layer on the subgrade and the box they are poured into,
/// whose sides are rigid planes round the z axis, unless there is a
/// Container/mesh.
struct LayerParameters
{
  double length = 0.6;    ///< of the box, along x [m]
  double width = 0.6;     ///< of the box, along y [m]
  double thickness = 0.2; ///< about, when they have come to rest [m]
  double solid_fraction =
      0.58; ///< with the box: sets the volume of particles [-]
  /// File or run of placed particles instead of drawn ones; may be empty.
  std::string particles;
  double largest_overlap = 0.05; ///< as placed, over the radius [-]
  std::string gradation = "gradations/los_angeles_20_45mm.csv";
  std::string shapes = "shapes/limestone_blocky";
  int order = dem::max_order; ///< N_s: at most this many degrees of the files
  int seed = 1;
  int layers = 1; ///< that it is poured in
  /// to the solid fraction; else the particles just fall
  bool is_tamped = true;
  double tamper_speed = 0.1;           ///< [m/s]
  double tamper_pressure = 200e3;      ///< at which the tamper turns back [Pa]
  int max_strokes = 4;                 ///< of the tamper on one layer
  double initial_solid_fraction = 0.2; ///< of the cloud that falls [-]
  double friction = 0.2;          ///< particle on particle while pouring [-]
  double local_damping = 0.3;     ///< D_a until loading begins [-]
  double unbalanced_ratio = 5e-3; ///< resultant forces over weight at rest [-]
  double max_time = 2.; ///< for a layer, and for the plate, to come to rest [s]
  double safety = 0.;   ///< share of the stable step; 0: steps as later [-]
};

enum class PlateForm
{
  disc,
  block ///< a sleeper
};

enum class PlateMotion
{
  vertical, ///< guided
  free      ///< moves and turns
};

/// The rigid body that loads the particles.
struct LoadPlateParameters
{
  PlateForm form = PlateForm::disc;
  double diameter = 0.3;   ///< of a disc [m]
  double length = 0.6;     ///< of a block, along x [m]
  double width = 0.25;     ///< of a block, along y [m]
  double height = 0.05;    ///< [m]
  double mass = 50.;       ///< [kg]
  double static_load = 0.; ///< on it besides its weight, always [N]
  PlateMotion motion = PlateMotion::vertical;
};

enum class GroundSide
{
  absorbing, ///< dashpots, and springs of the half-space beyond
  rigid      ///< bottom: held; sides: along their normals
};

enum class GroundBody
{
  full,
  condensed ///< on the nodes of its top
};

enum class GroundSolver
{
  direct,         ///< factors
  amg,            ///< conjugate gradients with multigrid
  distributed_amg ///< the same with its matrices spread over the ranks
};

struct GroundParameters
{
  std::string mesh;   ///< gmsh file of hexahedra; empty: a box
  double length = 2.; ///< along x [m]
  double width = 2.;  ///< along y [m]
  /// thickness [m], E [Pa], nu [-], rho [kg/m^3] of each layer from the top
  /// down; where it yields c [Pa], phi and psi [degrees] too
  std::string layers = "0.4 80e6 0.3 1900, 1 50e6 0.35 1850";
  double cell_size = 0.05; ///< under the plate [m]
  double growth = 1.3;     ///< of the cells away from it, from one to the next
  GroundSide bottom = GroundSide::absorbing, sides = GroundSide::absorbing;
  double mass_damping = 0.;      ///< Rayleigh alpha [1/s]
  double stiffness_damping = 0.; ///< Rayleigh beta [s]
  GroundBody body = GroundBody::full;
  int inner_modes = 60;                       ///< of a condensed body
  GroundSolver solver = GroundSolver::direct; ///< of a full body
  double solver_tolerance = 1e-10; ///< of both amg: residual over load [-]
};

enum class PulseForm
{
  haversine,
  sine,
  train,         ///< axles of a train that pass
  table,         ///< a CSV file
  eccentric_mass ///< that turns on the plate
};

enum class AxleShareForm
{
  zimmermann,
  table
};

struct PulseParameters
{
  PulseForm form = PulseForm::haversine;
  double amplitude = 10e3; ///< of haversine and sine, peak [N]
  double frequency = 20.;  ///< of all but train and table [Hz]
  int cycles = 3;
  double pause = 0.;             ///< after each cycle of haversine and sine [s]
  double eccentric_mass = 2.4;   ///< that turns at the frequency [kg]
  double eccentricity = 3.32e-3; ///< of it from its axis [m]
  std::string table;             ///< CSV: time_s, force_N
  double axle_load = 20e3;       ///< [N]
  double axle_spacing = 2.5;     ///< of a bogie [m]
  double bogie_spacing = 17.375; ///< of a car, centres [m]
  double car_length = 24.775;    ///< from car to car [m]
  int cars = 1;
  double speed = 60.; ///< [m/s]
  AxleShareForm share = AxleShareForm::zimmermann;
  double sleeper_spacing = 0.6;  ///< [m]
  double rail_stiffness = 6.4e6; ///< E I of one rail [N m^2]
  double track_modulus = 40e6;   ///< of one rail [N/m^2]
  std::string share_table;       ///< CSV: distance_m, share_1
  double rest = 0.1;             ///< after the last pulse [s]
};

struct RecordParameters
{
  double row_interval = 5e-4;       ///< between rows of history.csv [s]
  double frame_interval = 0.;       ///< between frames; 0: first and last [s]
  double checkpoint_interval = 0.1; ///< 0: only at the end [s]
  std::string stress_depths = "0.1 0.3 0.6"; ///< below the plate [m]
  double highest_frequency = 100.;           ///< of transfer.csv [Hz]
  int slices = 5; ///< of the particles, in profile.csv
};

struct SubgradeParameters
{
  LayerParameters layer;
  LoadPlateParameters plate;
  GroundParameters ground;
  /// particles on the ground: soil gives more than steel
  dem::WallMaterial contact{.normal_stiffness = 5e6,
                            .shear_stiffness = 4.25e6,
                            .friction = 0.5,
                            .rolling_friction = 0.,
                            .normal_damping = 0.3,
                            .shear_damping = 0.3};
  PulseParameters pulse;
  RecordParameters record;
};

/// One layer of the ground.
struct GroundLayer
{
  double thickness = 0.;      ///< [m]
  double youngs_modulus = 0.; ///< [Pa]
  double poisson_ratio = 0.;  ///< [-]
  double density = 0.;        ///< [kg/m^3]
  /// c [Pa]; infinite: elastic
  double cohesion = std::numeric_limits<double>::infinity();
  double friction_angle = 0.;  ///< phi [degrees]
  double dilatancy_angle = 0.; ///< psi [degrees]
};
bool yields(const GroundParameters &ground);

/// Throws std::invalid_argument with what is allowed.
std::vector<GroundLayer> parse_ground_layers(const std::string &text);
std::vector<double> parse_depths(const std::string &text);
/// Heights of the layers' tops from the bottom up [m].
std::vector<double> layer_tops(const GroundParameters &ground);
/// Of all layers [m].
double depth_of(const GroundParameters &ground);
/// Half the length and width of the footprint [m].
struct Footprint
{
  double half_x = 0., half_y = 0.;
};
Footprint footprint(const LoadPlateParameters &plate);
} // namespace spall
