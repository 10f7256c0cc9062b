#pragma once

#include <dem/engine.h>
#include <dem/packing/container.h>
#include <dem/packing/insertion.h>

#include <iosfwd>
#include <memory>
#include <span>
#include <stdexcept>
#include <vector>

namespace dem
{
/// An upright room with a flat floor, round (as wide as x) or a box, or of any
/// shape. Its walls and its floor are whatever the engine has there.
struct Room
{
  Vec3 floor = Vec3::Zero();         ///< middle of the floor, lowest [m]
  double width_x = 1., width_y = 1.; ///< of a box around it [m]
  bool is_round = false;
  /// Whose lowest point is at the height of the floor; null: none.
  std::shared_ptr<const Container> container = {};

  /// Cross-section at its top [m^2].
  double section() const;
  /// At a height above the floor [m^2].
  double section_at(double height) const;
  /// Up to a height above the floor [m^3].
  double volume_below(double height) const;
  /// Up to which a mass has this density [kg, kg/m^3 to m].
  double height_of(double mass, double density) const;
};

struct PouringParameters
{
  /// Required of particles under `level_pressure`: mass over volume of the room
  /// up to the tamper; 0: the layers are not tamped [kg/m^3].
  double density = 0.;
  /// Layers that the next ones will press on may stay looser: the first by this
  /// share of the density, the last by none (undercompaction, Ladd 1978) [-].
  double undercompaction = 0.;
  double friction = 0.2; ///< particle on particle until the last layer is in
  /// Of the cloud that falls; less where particles find no free position [-].
  double solid_fraction = 0.2;
  double tamper_speed = 0.1;    ///< [m/s]
  double tamper_pressure = 2e5; ///< at which the tamper turns back [Pa]
  double level_pressure = 5e3;  ///< under which the height is taken [Pa]
  int max_strokes = 4;          ///< of the tamper on one layer
  /// Share of the friction left by each stroke that meets its pressure above
  /// the density, when all particles are in; 1: the friction stays [-].
  double friction_decay = 1.;
  double tolerance = 2e-3; ///< of the density; no more strokes [-]
  /// Of particles at rest: sum of the resultant forces over the weight; before
  /// the tamper comes ten times as much will do [-].
  double unbalanced_ratio = 1e-3;
  double max_time = 2.; ///< for a layer to come to rest, then it fails [s]
};

/// Particles of all sizes into `n` layers of about the same mass and gradation,
/// largest first in each.
std::vector<std::vector<ParticleShape>>
deal_layers(std::span<const ParticleShape> particles, int n);

/// Where the particles of a layer are and how they move when it comes in.
struct PlacedLayer
{
  std::vector<Placement> placement;
  std::vector<Vec3> velocity, spin; ///< [m/s], [rad/s]
};

/// A layer does not come to rest in time.
class NoRest : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// Fills a room with particles, layer by layer: a cloud of particles falls in,
/// comes to rest, and is tamped by a plane that comes down until it is felt and
/// the density is reached (a stroke that springs back is followed by a deeper
/// one) or its pressure is at the limit. Layers thinner than their largest
/// particles may stay looser than the whole becomes; if the whole is looser
/// than required, strokes continue with less and less friction. Particles that
/// slide easily may be denser than required before tamping. Layer reports what
/// was reached. At last the particles get their friction back and come to rest.
/// Gravity, damping and steps are the caller's.
class Pouring
{
public:
  enum class Stage : std::int32_t
  {
    waiting,  ///< for the next layer
    settling, ///< particles fall
    tamping,
    lifting, ///< of the tamper
    resting,
    done
  };

  /// What a layer has come to.
  struct Layer
  {
    double mass = 0.;     ///< of it and those below [kg]
    double height = 0.;   ///< under level_pressure; without tamping none [m]
    double density = 0.;  ///< mass over room [kg/m^3]
    double pressure = 0.; ///< largest of the tamper, mean of 0.2 ms [Pa]
    double time = 0.;     ///< when it was done [s]
    double friction = 0.; ///< of the particles under the last stroke [-]
    std::int64_t strokes = 0;
  };

  /// `layers` must not be empty; largest particles first in each.
  Pouring(const Room &room, const PouringParameters &parameters,
          std::vector<std::vector<ParticleShape>> layers, std::uint64_t seed);

  /// The first layer begins like this, instead of as a cloud that is drawn; the
  /// order of its particles is free then. The engine has no particles before.
  void set_first_layer(PlacedLayer placed);

  /// Adds the tamper, a plane that is out of the way until it is needed.
  void prepare(Engine &engine);

  /// Before each step of the engine: what is due, and the speed of the tamper.
  /// Throws NoFreePosition or NoRest if a layer finds none.
  void steer(Engine &engine, double time_step);

  /// Of the whole filling, about: a layer falls and rolls to rest in three
  /// falls through its cloud, and the tamper goes through the height of its
  /// largest particle [s]. Time with half of the particles counts half.
  double expected_time(const Vec3 &gravity) const;
  bool is_done() const { return now.stage == Stage::done; }
  Stage stage() const { return now.stage; }
  /// Of the layers that are done.
  std::span<const Layer> layers() const { return finished; }
  std::size_t n_layers() const { return bodies.size(); }
  /// All particles in the order in which they come, that of their ids, and
  /// their number.
  std::vector<ParticleShape> particles() const;
  std::size_t n_particles() const;
  /// At the last check [-].
  double unbalanced_ratio() const { return now.unbalanced_ratio; }
  /// Number of the plane that tamps: up there and inactive when all is done.
  std::size_t tamper() const { return plane; }

  void save(std::ostream &out) const;
  void restore(std::istream &in);

private:
  void pour(Engine &engine);
  void pour_cloud(Engine &engine) const;
  void pour_placed(Engine &engine) const;
  double fall_height(std::size_t layer) const;
  std::vector<Placement> cloud_above(double floor,
                                     const InsertionBox &slab) const;
  bool is_at_rest(Engine &engine, double limit);
  void settle(Engine &engine);
  void lower_tamper(Engine &engine);
  void tamp(Engine &engine);
  void lift(Engine &engine);
  bool goes_on(Engine &engine);
  void close_layer(Engine &engine);
  void enter(Stage next, const Engine &engine);
  void follow_pressure(const Engine &engine, double time_step);
  double goal() const;

  /// Plain data for the checkpoint.
  struct State
  {
    Stage stage = Stage::waiting;
    std::int32_t strokes = 0; ///< on the present layer
    std::int64_t decays = 0;  ///< of the friction
    double since = 0.;        ///< when the stage began [s]
    double mass = 0.;         ///< of the particles so far [kg]
    double depth = 0.;        ///< that a stroke goes to above the floor [m]
    double pressure = 0.;     ///< of the tamper, mean of some steps [Pa]
    double peak = 0.;         ///< of the layer [Pa]
    double level = 0.;        ///< above the floor, last taken [m]
    double unbalanced_ratio = 0.;
    double friction = 0.; ///< of the particles when all is done [-]
  };

  Room room;
  PouringParameters parameters;
  std::vector<std::vector<ParticleShape>> bodies;
  std::uint64_t seed;
  PlacedLayer first; ///< empty: it is drawn
  std::size_t plane = 0;
  State now;
  std::vector<Layer> finished;
};

/// Upper bound of where the particles of all ranks end [m]; the floor without
/// particles. Collective.
double top_of(const Engine &engine, double floor);

/// Sum of the resultant forces on the particles of all ranks over the sum of
/// their weights [-]. Collective.
double unbalanced_weight_ratio(const Engine &engine);
} // namespace dem
