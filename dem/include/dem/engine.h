#pragma once

#include <dem/boundary/drum.h>
#include <dem/boundary/surface_contacts.h>
#include <dem/breakage/events.h>
#include <dem/breakage/patch_factors.h>
#include <dem/contact/placed_walls.h>
#include <dem/integrate/time_step.h>
#include <dem/integrate/verlet.h>
#include <dem/measure/assembly.h>
#include <dem/search/candidates.h>
#include <dem/search/contact_point_lists.h>
#include <dem/search/skin_width.h>

#include <iosfwd>
#include <memory>

namespace dem
{
/// Energy of the particles now, and what has passed since construction [J].
struct EngineEnergy
{
  double kinetic = 0.;  ///< now
  double elastic = 0.;  ///< now, all springs of all contacts
  double friction = 0.; ///< dissipated
  double rolling = 0.;  ///< dissipated
  double damping = 0.;  ///< dissipated by dashpots and local damping
  double breakage = 0.; ///< released by events, lost kinetic energy included
  double non_conservative_work = 0.; ///< springs gained (negative) by turning
  double fracture = 0.;              ///< sum of G_c A_i over the events
  double plane_work = 0.;            ///< done by the planes on the particles
  double drum_work = 0.;             ///< done by the drum on the particles
  double surface_work = 0.; ///< done by the facet surfaces on the particles
  double gravity_work = 0.;
};

/// Wall-clock spent in the phases of a step since construction [s].
struct EngineClock
{
  double contacts = 0., search = 0., breakage = 0., motion = 0.;
};

/// The particles, their contacts and boundaries, and how they move: the one
/// class of dem with state.
class Engine
{
public:
  explicit Engine(const EngineParameters &parameters);

  /// A particle at rest, at any time; of another material than 0 it does not
  /// break.
  void add_particle(const ParticleShape &body, const Vec3 &position,
                    const Quaternion &orientation, std::uint8_t material = 0);
  /// Returns the number of the plane.
  std::size_t add_plane(const Vec3 &point, const Vec3 &normal);
  /// The drum of the scene (one); its spin may change at any time.
  void set_drum(const Drum &drum);
  /// Adds a facet surface; returns its number. Throws std::invalid_argument on
  /// a surface that is none, or a name that is taken.
  std::size_t add_surface(const std::string &name, const WallMaterial &material,
                          FacetSurface surface);
  /// Adds one with the law EngineParameters::surface; library only.
  void attach_surface(FacetSurface surface);

  /// One velocity Verlet step [s]. Velocities of planes and the motion of
  /// facet surfaces (already at the end of the step) are set before. Throws
  /// std::runtime_error where particles leap by a hundred radii: too long a
  /// step; OverlapStop where a contact is deeper than OverlapLimits::stop.
  void advance(double time_step);
  /// The same for one who goes on without a look at the particles: the last
  /// half kick waits for the first of the next step, one pass over the
  /// particles for both, or until anything here asks for it; all bits stay the
  /// same. Only through a reference from before are velocities seen half a step
  /// late.
  void advance_deferred(double time_step);

  /// Loads of all contacts as the scene was placed, before its first step:
  /// nothing moves. Dashpots see the velocities; tangential and rolling springs
  /// start at zero and take up the motion of `time_step` [s]. For the look at
  /// one contact see dem/measure/single_contact.h. Throws std::logic_error once
  /// lists of contacts are there.
  void evaluate(double time_step);

  const EngineParameters &parameters() const { return settings; }
  void set_friction(double friction);
  void set_local_damping(double damping);
  /// How soon contacts and lists are renewed, as GeometryParameters has it; the
  /// lists from the next ones on.
  void set_renewal(double refresh_tolerance, double skin);
  /// From now on a particle that has come through a wall does not stop the
  /// engine, nor does an overlap above OverlapLimits::stop: of rough packings,
  /// whose overlaps may push some out.
  void allow_escape() { keeps_inside = false; }
  /// Takes all velocity from the particles; booked as damping.
  void come_to_rest();
  /// Whether particles break from now on; off: no damage grows either.
  void set_breaking(bool is_on);
  /// Of the rises of energy, as BreakageParameters::repetitions [-], of the
  /// load that begins now: what contacts have borne before counts no longer.
  void set_repetitions(double repetitions);

  /// As they are at time().
  const ParticleSystem &particles() const
  {
    finish_kick();
    return system;
  }
  ParticleSystem &particles()
  {
    finish_kick();
    return system;
  }
  const ContactBatch &pairs() const { return pair_batch; }
  const ContactBatch &on_planes() const { return plane_batch; }
  const ContactBatch &on_drum() const { return drum_batch; }
  Drum &drum() { return barrel; }
  const Drum &drum() const { return barrel; }
  std::vector<Plane> &planes() { return walls; }
  const std::vector<Plane> &planes() const { return walls; }
  void deactivate_plane(std::size_t plane);
  /// Puts a plane elsewhere, where it is active and at rest.
  void place_plane(std::size_t plane, const Vec3 &point);
  std::span<SurfaceContacts> surfaces() { return facet_surfaces; }
  std::span<const SurfaceContacts> surfaces() const { return facet_surfaces; }
  /// Parts of one of the surfaces.
  FacetSurface &surface(std::size_t number = 0)
  {
    return facet_surfaces.at(number).surface;
  }
  const FacetSurface &surface(std::size_t number = 0) const
  {
    return facet_surfaces.at(number).surface;
  }
  const ContactBatch &on_facets(std::size_t number = 0) const
  {
    return facet_surfaces.at(number).batch;
  }
  const FacetCandidates &facets(std::size_t number = 0) const
  {
    return facet_surfaces.at(number).candidates;
  }

  double time() const { return now; }        ///< [s]
  void set_time(double time) { now = time; } ///< of the clock alone [s]
  std::int64_t n_steps() const { return step_count; }
  std::int64_t n_rebuilds() const { return rebuild_count; }
  /// All that is nearer than this to each other is listed [m].
  double listed_gap() const { return margin.left; }
  /// Of contacts that follow the true surfaces, since construction.
  const ContactPointEvents &contact_point_events() const
  {
    return contact_points.events;
  }
  EngineEnergy energy() const;
  EngineClock clock() const { return spent; }
  const OverlapRecord &overlaps() const { return overlap; }
  /// OverlapRecord::recent begins again.
  void begin_overlap_interval() { overlap.recent = 0.; }
  /// Events since the last call.
  std::vector<BreakageEvent> take_events();
  std::int64_t n_events() const { return event_count; }
  int n_refused_events() const { return refused_count; }

  /// Full state, bit for bit, into a stream; restore() on an engine with the
  /// same parameters and the same shared shapes (`library`, in order).
  void
  save(std::ostream &out,
       const std::vector<std::shared_ptr<const Coefficients>> &library) const;
  /// Throws std::runtime_error if the stream does not fit.
  void restore(std::istream &in,
               const std::vector<std::shared_ptr<const Coefficients>> &library);

private:
  Speeds move_particles(double time_step);
  void finish_kick() const;
  void move_planes(double time_step);
  void keep_lists(const Speeds &fastest, double time_step);
  SkinWidth::Lists list_counts() const;
  void rebuild_lists();
  void check_displaced();
  void renew_lists();
  void update_maps();
  void rebuild_pair_list();
  void rebuild_plane_list();
  void rebuild_drum_list();
  void rebuild_facet_list(SurfaceContacts &facets);
  void check_facets();
  void gather_facets(const WallSearch &search, SurfaceContacts &facets);
  bool follows_walls() const; ///< particles, with their surfaces
  ContactGeometry pair_geometry() const;
  ContactPointSearchInput contact_point_search(const ForceContext &still,
                                               const BatchLayout &layout) const;
  void sort_in_space();
  bool evaluate_contacts(double time_step);
  void meet_walls(double time_step);
  bool run_contacts(const ForceContext &all);
  void count_places(const ForceSum &sum);
  void note_overlap(double ratio);
  std::string deepest_contact() const;
  PlacedDrum placed_drum();
  PlacedFacets placed_facets(SurfaceContacts &facets);
  Walls walls_of_planes();
  Walls walls_of_drum();
  Walls walls_of_facets(SurfaceContacts &facets);
  void exchange_factors();
  void break_corners();
  void load_boundaries(double time_step);
  double branch_steepness() const;
  void load_planes(double time_step);
  void load_drum(double time_step);
  void book_drum(double time_step);
  ForceContext context(double time_step);
  /// Calls call(batch) for the contacts with particles, planes, drum and
  /// facets.
  template <class Self, class Call>
  static void visit_batches(Self &self, const Call &call)
  {
    call(self.pair_batch);
    call(self.plane_batch);
    call(self.drum_batch);
    for (auto &facets : self.facet_surfaces)
      call(facets.batch);
  }
  /// Calls call(value) for every plain value that a checkpoint keeps.
  template <class Self, class Visit>
  static void visit_state(Self &self, const Visit &call);

  EngineParameters settings;
  ElasticityTable elasticity;
  // Const functions too give the kick that is owed: what is seen of the
  // particles does not depend on when.
  mutable ParticleSystem system;
  mutable WorkColumns work;
  mutable double pending_half_kick =
      0.; ///< the last of the step, or nothing [s]
  mutable EngineClock spent;
  std::vector<Plane> walls;
  std::vector<SurfaceContacts> facet_surfaces;
  Drum barrel;
  DrumLifter lifter; ///< where `barrel` stands; read where places are
  ContactBatch pair_batch, plane_batch, drum_batch;
  PairLoads pair_loads;
  PatchFactors patches; ///< empty unless patches keep factors

  bool keeps_inside = true; ///< allow_escape() has not been called
  bool lists_are_stale = true;
  bool places_are_stale = false; ///< contacts have displaced
  bool facets_are_stale = false; ///< those alone, where particles follow them
  SkinWidth margin;
  PairFinder pair_finder;
  ParticleMaps maps; ///< of true surfaces
  ContactPointLists contact_points;
  Travel travel;
  double steepest = 0.;         ///< c of closing_speed [-]
  double travelled = 0.;        ///< ForceContext::travelled [m]
  double stride = 0.;           ///< ForceContext::stride [m]
  double walls_travelled = 0.;  ///< planes and drum, the fastest [m]
  double sheets_travelled = 0.; ///< facets, the fastest vertex [m]
  double facets_left = 0.;      ///< of it and particles, to the next look [m]
  double travelled_sorted = 0.; ///< when the particles were last sorted [m]
  double now = 0.;
  std::int64_t step_count = 0, rebuild_count = 0, event_count = 0;
  int refused_count = 0;
  Dissipation lost;
  OverlapRecord overlap;
  double least_radius = 0.; ///< no equivalent sphere is smaller [m]
  double released = 0., fractured = 0.;
  std::vector<BreakageEvent> events;

  // Space to work in, kept from step to step.
  std::vector<RangeSum> ranges;
  std::vector<WallRow> plane_walls;
  std::vector<WallRow> drum_walls; ///< those of the last step are read
  std::vector<double> drum_overlap;
};
} // namespace dem
