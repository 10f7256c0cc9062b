#pragma once

#include <dem/breakage/patch_factors.h>
#include <dem/contact/lost_energy.h>
#include <dem/engine.h>
#include <dem/integrate/verlet.h>
#include <dem/neighbor/schedule.h>
#include <dem/parallel/distribution.h>

namespace dem
{
/// A particle that is to be added.
struct NewParticle
{
  ParticleShape body;
  Vec3 position;
  Quaternion orientation;
  std::uint8_t material = 0;
  std::int64_t id = 0;
};

/// What an engine owns, and the order of a step. The functions that Engine has,
/// too, are described there.
class EngineState
{
public:
  EngineState(const EngineParameters &parameters, std::shared_ptr<Ranks> ranks);
  void add_particle(const ParticleShape &body, const Vec3 &position,
                    const Quaternion &orientation, std::uint8_t material = 0);
  Boundary &add_boundary(std::unique_ptr<Boundary> boundary);
  std::span<const std::unique_ptr<Boundary>> boundaries() const
  {
    return walls;
  }
  void lists_changed() { schedule.invalidate(); }
  void set_periodic_cell(const Vec3 &centre, const Vec3 &length);
  const PeriodicCell &cell() const { return system.cell; }
  void set_cell_rate(const Vec3 &rate) { system.cell.rate = rate; }
  void advance(double time_step);
  void advance_deferred(double time_step);
  void evaluate(double time_step);

  const EngineParameters &parameters() const { return settings; }
  void set_friction(double friction);
  void set_local_damping(double damping);
  void set_renewal(double refresh_tolerance, double skin);
  void allow_escape() { keeps_inside = false; }
  void come_to_rest();
  void set_breaking(bool is_on);
  void set_repetitions(double repetitions);
  void synchronize();
  const ParticleSystem &particles() const
  {
    require_synchronized();
    return system;
  }
  ParticleSystem &particles()
  {
    synchronize();
    return system;
  }
  const ContactBatch &pairs() const { return pair_batch; }

  double time() const { return now; }        ///< [s]
  void set_time(double time) { now = time; } ///< of the clock alone [s]
  std::int64_t n_steps() const { return step_count; }
  std::int64_t n_rebuilds() const { return schedule.n_made; }
  double listed_gap() const { return schedule.skin.left; }
  const Distribution &shares() const { return distribution; }
  void set_partition_interval(std::int64_t interval)
  {
    partition_interval = interval;
  }
  const ContactPointEvents &contact_point_events() const
  {
    return contact_points.events;
  }
  EngineEnergy energy() const;
  EngineClock clock() const { return spent; }
  const OverlapRecord &overlaps() const { return overlap; }
  void begin_overlap_interval() { overlap.recent = 0.; }
  std::vector<BreakageEvent> take_events();
  std::int64_t n_events() const { return event_count; }
  int n_refused_events() const { return refused_count; }
  using Library = std::vector<std::shared_ptr<const Coefficients>>;
  bool is_shareable() const { return obstacle_to_sharing().empty(); }
  void save(std::ostream &out, const Library &library, StateExtent extent);
  void restore(std::istream &in, const Library &library);
  void admit_arrivals();
  std::unique_ptr<EngineState> gathered();
  void order_by_id();

private:
  /// Every plain value that a checkpoint stores.
  void copy_values_to(EngineState &copy) const;
  std::unique_ptr<EngineState> copy_of_values() const;
  std::unique_ptr<EngineState> scene_without_particles();
  std::unique_ptr<EngineState> own_part() const;
  void save_rows(std::ostream &out, const Library &library) const;
  void restore_rows(std::istream &in, const Library &library);
  void save_scene(std::ostream &out, const Library &library);
  void save_block(std::ostream &out, const Library &library);
  void restore_block(std::istream &in, const Library &library);
  void restore_blocks(std::istream &in, const Library &library,
                      std::int64_t n_blocks);
  void deal_out();
  void keep_partners();
  void append(const NewParticle &particle);
  Speeds move_particles(double time_step);
  /// Throws std::logic_error where a half kick is pending.
  void require_synchronized() const;
  void move_boundaries(double time_step);
  void move_cell(double time_step);
  void book_cell(double time_step);
  double cell_speed() const;
  Speeds over_ranks(const Speeds &own);
  /// What cannot be spread over ranks; empty: nothing.
  std::string obstacle_to_sharing() const;
  void require_shareable() const;
  void redistribute();
  void search_pairs();
  void search_contact_points();
  bool needs_search() const;
  double usual_skin() const;
  double pair_skin() const;
  double contact_point_skin() const;
  bool follows_pairs() const; ///< particles meet with their surfaces
  void send_states();
  void share_loads();
  void keep_lists(const Speeds &fastest, double time_step);
  SkinWidth::Lists list_counts() const;
  void rebuild_lists();
  void note_extremes();
  void keep_grid();
  void note_forces(double recent);
  void add_loads_again();
  void sum_loads();
  void renew_lists();
  void renew_displaced_lists();
  void update_maps();
  void rebuild_pair_list();
  void renew_deforming_lists();
  void find_boundary_candidates(bool of_deforming_alone);
  bool follows_walls() const; ///< particles, with their surfaces
  ContactGeometry pair_geometry() const;
  ContactPointSearchInput contact_point_search(const ForceContext &still,
                                               const BatchLayout &layout) const;
  void sort_in_space();
  void put_in_order(const std::vector<std::int32_t> &order);
  bool evaluate_contacts(double time_step);
  void meet_walls(double time_step);
  bool run_contacts(const ForceContext &all);
  void count_contact_point_events(const ForceSum &sum);
  void note_overlap(double ratio);
  std::string deepest_contact() const;
  void exchange_factors();
  void break_corners();
  BreakingSum carry_out_breakage();
  DistributedParts parts();
  void load_boundaries(double time_step);
  double branch_steepness() const;
  ForceContext context(double time_step);
  /// Calls call(batch) for the contacts of particles with each other and with
  /// each boundary.
  template <class Self, class Call>
  static void visit_batches(Self &self, const Call &call)
  {
    call(self.pair_batch);
    for (const auto &boundary : self.walls)
      call(boundary->batch);
  }
  /// Calls call(value) for every plain value that a checkpoint stores.
  template <class Self, class Visit>
  static void visit_state(Self &self, const Visit &call);

  Distribution distribution;
  EngineParameters settings;
  ElasticityTable elasticity;
  ParticleSystem system;
  WorkColumns work;
  /// Second half of the kick of the last step that is still due; 0: none [s].
  double pending_half_kick = 0.;
  EngineClock spent;
  std::vector<std::unique_ptr<Boundary>> walls;
  ContactBatch pair_batch;
  PairLoads pair_loads;
  PatchFactors patches; ///< empty unless patches keep factors

  bool keeps_inside = true; ///< allow_escape() has not been called
  NeighborSchedule schedule;
  PairFinder pair_finder;
  ParticleMaps maps; ///< of true surfaces
  ContactPointLists contact_points;
  /// No two particles are more lengths of the periodic cell apart [-].
  Vec3 image_span = Vec3::Zero();
  double steepest = 0.;         ///< c of closing_speed [-]
  std::int64_t added_count = 0; ///< particles, on all ranks
  std::int64_t partition_interval = 0, redistribution_count = 0;
  /// Particles that this rank adds when they can go to their owners.
  std::vector<NewParticle> arrivals;
  std::int64_t n_admitted = 0; ///< of added_count
  bool wants_breakage = false; ///< some contact, of any rank
  std::string fault;           ///< of this rank in this step, for all of them
  double path_at_sort = 0.;    ///< when the particles were last sorted [m]
  double now = 0.;
  std::int64_t step_count = 0, event_count = 0;
  int refused_count = 0;
  SumGrid grid;              ///< of loads
  double grid_force = 0.;    ///< contact force that it is made for [N]
  double largest_force = 0.; ///< of a contact in this step, on this rank [N]
  bool has_large_forces = false; ///< beyond the grid, on any rank
  double recent_force = 0.;      ///< since keep_grid() last looked [N]
  LostEnergy lost;
  OverlapRecord overlap;
  /// Equivalent spheres of all ranks [m].
  double least_radius = 0., largest_radius = 0.;
  double released = 0., fractured = 0.;
  std::vector<BreakageEvent> events;

  // Space to work in, kept from step to step.
  std::vector<RangeSum> ranges;
};
} // namespace dem
