#pragma once

#include "case/kind.h"
#include "case/wall_section.h"
#include "compaction/case.h"
#include "subgrade/case.h"

#include <coupling/cycle_jump.h>
#include <coupling/exchange.h>
#include <dem/breakage/criterion.h>
#include <dem/contact/law_table.h>
#include <dem/parameters/material.h>
#include <fem/membrane.h>

#include <any>
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <typeindex>
#include <vector>

namespace spall
{
enum class Lateral
{
  membrane, ///< deal.II membrane, tied to the plates
  rigid,    ///< four servo-controlled planes
  periodic  ///< opposite sides are one: a cell that is periodic along x and y
};

enum class StepRule
{
  fixed,  ///< Time/fixed_step
  stable, ///< at most Time/safety times what the present contacts allow
  error   ///< as stable, and short enough for the tolerances
};

/// How particles and membrane are integrated in time together; must be set.
enum class ExchangeChoice
{
  none,
  every_step, ///< as coupling::ExchangeRule
  one_pass,
  iterated
};

enum class SurfaceFrames
{
  none,
  ends, ///< before the first and after the last cycle
  all   ///< with every frame
};

/// Tables besides the ParaView files, of every kind.
enum class FrameTables
{
  none,
  hdf5 ///< a file with every frame
};

enum class SpecimenForm
{
  box,     ///< a cube
  cylinder ///< upright
};

struct SpecimenParameters
{
  SpecimenForm form = SpecimenForm::box;
  double side = 0.1;           ///< of the cube after compaction, about [m]
  double diameter = 0.1;       ///< of the cylinder after compaction, about [m]
  double height = 0.2;         ///< of the cylinder after compaction, about [m]
  double solid_fraction = 0.6; ///< with the size: volume of particles [-]
  /// File or run of placed particles instead of drawn ones; may be empty.
  std::string particles;
  double largest_overlap = 0.05; ///< as placed, over the radius [-]
  /// CSV: diameter_m, passing_1
  std::string gradation = "gradations/quick_7_22mm.csv";
  /// folder of shape files; empty: spheres
  std::string shapes = "shapes/limestone";
  int order = dem::max_order; ///< N_s: at most this many degrees of the files
  int seed = 1;
  double initial_solid_fraction = 0.25; ///< of the random cloud [-]
};

enum class PreparationTarget
{
  pressure, ///< at rest at the pressure, with the porosity that friction gives
  porosity  ///< friction is lowered until the porosity is met
};

struct PreparationParameters
{
  PreparationTarget target = PreparationTarget::pressure;
  double pressure = 30e3;         ///< isotropic [Pa]
  double porosity = 0.4;          ///< of the target porosity [-]
  double friction = 0.2;          ///< particle on particle while compacting [-]
  double wall_speed = 0.5;        ///< largest speed of a servo wall [m/s]
  double local_damping = 0.5;     ///< D_a [-]
  double stress_tolerance = 0.02; ///< of each axis against the target [-]
  double unbalanced_ratio = 1e-3; ///< largest unbalanced force ratio [-]
  double max_time = 1.;           ///< largest duration [s]
  double safety = 0.; ///< share of the stable step; 0: steps as loading [-]
};

/// Quads of a membrane that are halved both ways.
enum class MembraneRefinement
{
  none,
  pressed ///< those that particles press on when the membrane takes over
};

struct BoundaryParameters
{
  Lateral lateral = Lateral::membrane;
  std::string mesh;           ///< gmsh file of the membrane; may be empty
  int elements_per_side = 12; ///< of a box: membrane quads along each edge [-]
  int elements_around = 36;   ///< of a cylinder: membrane quads round it [-]
  MembraneRefinement refined = MembraneRefinement::none;
  /// of the servo of rigid sides: an error falls to 1/e in it [s]
  double servo_response_time = 5e-4;
  double servo_yielding = 0.3; ///< ServoParameters::yielding [-]
  double servo_dead_band = 0.; ///< ServoParameters::dead_band [-]
  double plate_mass = 5.;      ///< top plate [kg]
};

/// What the specimen is loaded by: a path or one of its short forms.
enum class LoadForm
{
  haversine,   ///< cycles of axial stress
  compression, ///< the plate moves down at a constant rate, once
  path         ///< the stages of a file
};

struct CouplingParameters
{
  ExchangeChoice exchange = ExchangeChoice::none;
  /// Rule and limit of the ledger are those given here. The tolerance is the
  /// coarsest that holds (docs/results/error_of_boundary.md).
  coupling::ExchangeParameters rules = []
  {
    coupling::ExchangeParameters usual;
    usual.tolerance = 1e-7;
    return usual;
  }();
  double ledger_limit = 0.05;    ///< see coupling::ExchangeParameters [-]
  bool is_body_implicit = false; ///< membrane or subgrade
  int body_steps = 1;            ///< of it in one window [-]

  /// Steps of the particles and the whole of the rules.
  coupling::ExchangeParameters exchange_rules() const;
  /// The same with a membrane or without one.
  coupling::ExchangeParameters exchange_rules(Lateral lateral) const;
};

struct LoadingParameters
{
  LoadForm form = LoadForm::haversine;
  std::string path; ///< CSV: a row for each stage of a loading path
  double confining_pressure = 30e3; ///< follower pressure and on the plate [Pa]
  double amplitude = 100e3;         ///< of the haversine, peak [Pa]
  double frequency = 20.;           ///< [Hz]
  int cycles = 10;
  double strain_rate = 0.1;   ///< of a compression, of the height [1/s]
  double final_strain = 0.05; ///< at the end of a compression [-]
  /// Consolidation on the boundaries of the loading lasts at least this long,
  /// and until the specimen is at rest [s].
  double consolidation_time = 0.02;
  double consolidation_max_time = 1.; ///< to rest after that, or it fails [s]
  double consolidation_stress_tolerance = 0.02; ///< of each axis at rest [-]
  double consolidation_unbalanced_ratio = 1e-3; ///< largest at rest [-]
};

/// TimeParameters::impact_error of preparations with steps of their own [-].
constexpr double preparing_impact_error = 0.1;

struct TimeParameters
{
  StepRule step = StepRule::fixed;
  double fixed_step = 1e-6;       ///< [s]
  double safety = 0.8;            ///< of the limit, rules stable and error [-]
  double impact_error = 0.02;     ///< energy error of an impact, not fixed [-]
  double force_tolerance = 0.01;  ///< of a load cycle, rule error [-]
  double energy_tolerance = 0.01; ///< of a load cycle, rule error [-]
  double local_damping = 0.5;     ///< D_a while loading (article, Table 2) [-]
  /// Smaller particles are accelerated as if they had its mass; 0: none [m].
  double density_scaling_diameter = 0.;
  /// A fixed step above the limit of the contacts is no reason to stop.
  bool allow_unstable_step = false;

  /// While particles are prepared: a share of the stable step; 0: as here.
  TimeParameters preparing(double own_safety) const
  {
    TimeParameters rule = *this;
    if (own_safety > 0.)
    {
      rule.step = StepRule::stable;
      rule.safety = own_safety;
      rule.impact_error = preparing_impact_error;
    }
    return rule;
  }
};

struct OutputParameters
{
  int samples_per_cycle = 50; ///< rows of history.csv
  int frames_per_cycle = 2;   ///< vtu frames
  int checkpoint_every = 1;   ///< cycles; 0: only at the end
  SurfaceFrames surfaces = SurfaceFrames::ends;
  FrameTables frame_tables = FrameTables::none;
  int pieces_above = 100000; ///< particles; frames of many ranks
};

/// The particle of the single-particle test.
struct SingleParticleParameters
{
  /// a shape file
  std::string shape = "shapes/limestone_blocky/MA111-7-coarse-00104.json";
  double diameter = 0.03; ///< twice the equivalent radius [m]
  int order = 20;         ///< N_s: at most this many degrees of the file
  /// Body direction that points up, of any length.
  double axis_x = 0., axis_y = 0., axis_z = 1.;
  int seed = 1; ///< of a random orientation instead; 0: the axis counts
};

/// The two rigid platens.
struct PressParameters
{
  double displacement = 2e-3; ///< of the upper platen, in all [m]
  double speed = 5e-3;        ///< of the upper platen [m/s]
  int rows = 1000;            ///< of history.csv, about
};

/// What is in the Los Angeles drum.
struct ChargeParameters
{
  double mass = 10.; ///< of the particles [kg]
  /// File or run of placed particles instead of drawn ones; may be empty.
  std::string particles;
  double largest_overlap = 0.05; ///< as placed, over the radius [-]
  /// CSV: diameter_m, passing_1
  std::string gradation = "gradations/los_angeles_20_45mm.csv";
  std::string shapes = "shapes/limestone_blocky";
  int order = dem::max_order; ///< N_s: at most this many degrees of the files
  int seed = 1;
  int balls = 12;           ///< steel balls
  double ball_mass = 5.;    ///< of all balls [kg]
  dem::SolidMaterial steel; ///< of the balls
};

struct DrumParameters
{
  double radius = 0.35;            ///< inner [m]
  double length = 0.5;             ///< inner [m]
  double lifter_height = 0.09;     ///< into the drum; 0: no lifter [m]
  double lifter_thickness = 0.025; ///< [m]
  double turns_per_minute = 32.;
  double turns = 2000.; ///< in all [-]
  /// The charge falls for at least this long, and until it is at rest [s].
  double settling_time = 0.5;
  double settling_max_time = 2.; ///< to rest after that, or it turns [s]
  double settling_unbalanced_ratio = 0.05; ///< at rest, over the weight [-]
  int rows_per_turn = 4;
  int frames_per_turn = 0;
  int checkpoint_every = 1; ///< turns; 0: only at the end
};

/// Largest number of OpenMP threads.
constexpr int most_threads = 1024;

struct Case
{
  std::string kind = "dynamic_triaxial"; ///< see TestKind::name
  std::string title = "dynamic triaxial test";
  SingleParticleParameters single_particle;
  PressParameters press;
  ChargeParameters charge;
  DrumParameters drum;
  ContainerParameters container;
  FillingParameters filling;
  PlateParameters plate;
  VibrationParameters vibration;
  SpecimenParameters specimen;
  PreparationParameters preparation;
  std::string material; ///< file with the next three and breakage; may be empty
  dem::ParticleMaterial particle;
  dem::WallMaterial wall;         ///< plates and rigid sides
  std::vector<WallSection> walls; ///< rigid walls of any shape
  /// particles on the membrane: a hundredth of the plates, so that a light node
  /// stays stable at the step of the particles
  dem::WallMaterial membrane_contact{.normal_stiffness = 1e6,
                                     .shear_stiffness = 0.85e6,
                                     .friction = 0.21,
                                     .rolling_friction = 0.,
                                     .normal_damping = 0.62,
                                     .shear_damping = 0.62};
  /// Parameters of every contact law, by its number: of particles on each other
  /// and on walls.
  std::vector<dem::LawValues> pair_laws = dem::default_law_values();
  std::vector<dem::LawValues> wall_laws = dem::default_law_values();
  dem::GeometryParameters contact;
  dem::FrictionLimit friction_limit = dem::FrictionLimit::elastic;
  dem::BreakageParameters breakage;
  fem::MembraneParameters membrane;
  BoundaryParameters boundary;
  CouplingParameters coupling;
  SubgradeParameters subgrade;
  LoadingParameters loading;
  coupling::CycleJumpParameters cycle_jump;
  TimeParameters time;
  OutputParameters output;
  int threads = 0;  ///< 0: the number that is fastest now
  std::string file; ///< the case file as given, for messages and paths
  /// One line for each old name that the case uses.
  std::vector<std::string> deprecated;
  /// One line for each value that is allowed and likely a slip.
  std::vector<std::string> notices;
  /// Digests of the files that the case names, by Section/key.
  std::map<std::string, std::uint64_t> contents;

  /// While particles are prepared: with steps of their own they also have
  /// contacts and lists renewed by the tolerances of the program.
  dem::GeometryParameters contact_preparing(double own_safety) const
  {
    dem::GeometryParameters geometry = contact;
    if (own_safety > 0.)
    {
      const dem::GeometryParameters usual;
      geometry.refresh_tolerance = usual.refresh_tolerance;
      geometry.skin = usual.skin;
    }
    return geometry;
  }

  /// Parameters of a kind of test that are no member of Case: one struct of
  /// this type, with its defaults at first.
  template <class T>
  T &own()
  {
    std::any &any = others[std::type_index(typeid(T))];
    if (!any.has_value())
      any = T{};
    return *std::any_cast<T>(&any);
  }
  /// The same; throws std::out_of_range if the kind has none.
  template <class T>
  const T &own() const
  {
    return *std::any_cast<T>(&others.at(std::type_index(typeid(T))));
  }

private:
  std::map<std::type_index, std::any> others;
};

/// A case of this kind with its defaults.
Case default_case(const std::string &kind);

/// The defaults of the kind of this case, with walls of the same names.
Case defaults_of(const Case &of);
} // namespace spall
