#pragma once

#include <dem/shape/spherical_harmonics.h>

#include <string>
#include <vector>

namespace spall
{
enum class ContainerForm
{
  rigid,   ///< a cylinder that does not move
  flexible ///< a tube of membrane, held at both rims
};

/// What the particles are poured into: an upright cylinder on a rigid floor, or
/// a mesh.
struct ContainerParameters
{
  ContainerForm form = ContainerForm::rigid;
  double diameter = 0.15; ///< inner [m]
  double height = 0.15;   ///< that the particles are to fill [m]
  /// File of triangles instead of the cylinder and its floor; may be empty.
  std::string mesh;
  double scale = 1.; ///< unit of that file [m]
  /// Flexible: quads round the tube; along it they are about as long.
  int elements_around = 36;
  double freeboard = 0.02; ///< of the flexible tube above the particles [m]
  double pressure = 0.;    ///< on the flexible tube, from outside [Pa]

  bool is_flexible() const { return form == ContainerForm::flexible; }
  bool has_mesh() const { return !mesh.empty(); }
};

/// The particles, and how they get into the container.
struct FillingParameters
{
  /// File or run of placed particles instead of drawn ones; may be empty.
  std::string particles;
  double largest_overlap = 0.05; ///< as placed, over the radius [-]
  /// CSV: diameter_m, passing_1
  std::string gradation = "gradations/compaction_10_45mm.csv";
  std::string shapes = "shapes/limestone"; ///< folder; empty: spheres
  int order = dem::max_order; ///< N_s: at most this many degrees of the files
  int seed = 1;
  double density =
      1760.; ///< mass of particles over volume of container [kg/m^3]
  int layers = 4;
  double undercompaction = 0.06;  ///< of the first layer [-]
  double solid_fraction = 0.2;    ///< of the cloud that falls [-]
  double friction = 1.2;          ///< particle on particle while filling [-]
  double friction_decay = 0.7;    ///< per stroke on what stays loose [-]
  double local_damping = 0.5;     ///< D_a while filling [-]
  double tamper_speed = 0.1;      ///< [m/s]
  double tamper_pressure = 300e3; ///< at which the tamper turns back [Pa]
  int max_strokes = 6;            ///< of the tamper on one layer
  double unbalanced_ratio = 1e-3; ///< resultant forces over weight at rest [-]
  double max_time = 2.;           ///< of a layer to come to rest [s]
  double safety = 0.; ///< share of the stable step; 0: steps as later [-]
};

enum class PlateKind
{
  rigid,   ///< moves along z only
  tilting, ///< rigid, moves along z and turns
  elastic
};

struct PlateParameters
{
  PlateKind form = PlateKind::rigid;
  /// All that moves along z: plate, static load, exciter with its mass [kg].
  double mass = 600.;
  /// Tilting: of the solid cylinder, as wide as the container, that has the
  /// mass [m].
  double height = 0.1;
  double thickness = 0.02;       ///< of an elastic plate [m]
  double youngs_modulus = 210e9; ///< of an elastic plate [Pa]
  double poisson_ratio = 0.3;    ///< of an elastic plate [-]
  double density = 7850.;        ///< of an elastic plate [kg/m^3]
  /// What an elastic plate carries rides within, and has no stiffness [m].
  double load_radius = 0.04;
  int elements = 4; ///< of an elastic plate, from its middle to its rim
  double load = 0.; ///< besides, without mass: a soft spring [N]
  double seating_speed = 0.05; ///< largest, until the particles carry it [m/s]
  /// The free plate rests for at least this long, and until it is at rest [s].
  double seating_time = 0.1;
  double seating_max_time = 2.;         ///< to rest after that, or it fails [s]
  double seating_load_tolerance = 0.02; ///< of the static load at rest [-]
  double seating_unbalanced_ratio = 5e-3; ///< largest at rest [-]
};

struct VibrationParameters
{
  double eccentric_mass = 2.4;    ///< [kg]
  double eccentricity = 3.32e-3;  ///< [m]
  double frequency = 32.;         ///< [Hz]
  double duration = 350.;         ///< [s]
  std::string reports = "50 350"; ///< times of vibration [s]
  int rows_per_period = 1;
  double frames_per_second = 0.;
  int checkpoint_every = 320; ///< periods; 0: only at the end
};

/// The numbers of VibrationParameters::reports [s]. Throws
/// std::invalid_argument unless they ascend from above zero.
std::vector<double> report_times(const std::string &text);
} // namespace spall
