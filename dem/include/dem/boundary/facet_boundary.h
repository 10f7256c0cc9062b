#pragma once

#include <dem/boundary/boundary.h>
#include <dem/boundary/facet_contacts.h>
#include <dem/boundary/facet_motion.h>
#include <dem/neighbor/candidate_pair.h>

namespace dem
{
/// A facet surface of the scene and the contacts of the particles on it.
class FacetBoundary : public Boundary
{
public:
  static constexpr const char *kind_name = "facets";

  /// `number`: of the facet surface in its scene. Throws std::invalid_argument
  /// as FacetTopology does, and on a law that attracts across gaps.
  FacetBoundary(std::string its_label, std::int64_t its_number,
                const WallMaterial &law, FacetSurface at_start);
  FacetBoundary();

  std::unique_ptr<Boundary> copy() const override
  {
    return std::make_unique<FacetBoundary>(*this);
  }
  std::string kind() const override { return kind_name; }
  std::string name_of(std::size_t) const override
  {
    return "the facets '" + label + "'";
  }
  int evaluation_order() const override { return 2; }
  int event_kind() const override { return 2; }
  std::int64_t event_other(std::size_t) const override { return number; }
  bool deforms() const override { return true; }
  bool can_be_shared() const override { return true; }
  double contact_cost() const override { return follows() ? 10. : 5.; }
  /// Whoever deforms it moves it.
  void move(double) override {}
  /// Throws std::runtime_error where a velocity is no finite number.
  double speed() const override;
  void find_candidates(const BoundarySearch &search) override;
  std::vector<CandidatePair> *candidates() override { return &near_particles; }
  void keep_particles(const std::vector<std::int32_t> &new_row) override;
  void
  pack_particles(std::ostream &out,
                 const std::vector<std::int32_t> &particles) const override;
  void unpack_particles(std::istream &in, std::size_t first) override;
  void keep_contacts(const std::vector<std::int32_t> &order) override;
  std::vector<std::int32_t> sort_contacts() override;
  void pack_contacts(std::ostream &out,
                     const std::vector<std::int32_t> &contacts) const override;
  void unpack_contacts(std::istream &in) override;
  void swap_contacts(Boundary &other) override;
  void take_contact(std::size_t k, const Boundary &other,
                    std::size_t l) override;
  ForceSum meet(const ForceContext &context) override;
  Walls walls(const ForceContext &context) override;
  BoundarySums sum_loads(const SumGrid &grid) override;
  void apply_loads(double time_step) override;
  double work() const override { return work_done; }
  double energy_beyond_springs(std::size_t k) const override;

  std::string label; ///< distinguishes the surfaces of a scene
  FacetSurface surface;
  FacetTopology topology;
  FacetCandidates near; ///< particles and triangles
  FacetContactPoints contact_points;
  /// Load on each vertex over time since somebody set it to zero, by the
  /// trapezoidal rule: the momentum that the particles have lost [N s].
  std::vector<Vec3> impulse;

  FacetMesh mesh() const { return {surface, topology}; }

  /// Where contact k presses; it has touched [m].
  Vec3 point_of(std::size_t k) const;
  /// WallContact::spread of contact k [N m].
  Mat3 spread_of(std::size_t k) const;

protected:
  void pack_parts(std::ostream &out) const override;
  void unpack_parts(std::istream &in) override;

private:
  /// Particles meet it with their surfaces.
  bool follows() const { return batch.layout.has_contact_points; }
  /// Calls visit(column) for the columns of the working space by contact.
  template <class Self, class Visit>
  static void visit_work_space(Self &self, const Visit &visit);
  void number_contacts();

  std::int64_t number = 0;
  double work_done = 0.;         ///< on the particles [J]
  std::uint8_t was_searched = 0; ///< by true surfaces
  std::vector<Vec3> load_before; ///< of the last step [N]
  /// Particles that may come to it, if they follow their surfaces; sorted.
  std::vector<CandidatePair> near_particles;
  FacetMotion watch; ///< what has moved since then

  /// Loads of the particles on the vertices by component, negative, and their
  /// spacing [N].
  std::vector<std::int64_t> load_counts;
  double load_spacing = 0.;

  // Space to work in, kept from step to step.
  std::vector<WallRow> rows;
  std::vector<double> overlap; ///< of particles that follow their surfaces [m]
  std::vector<double> extra;   ///< Walls::extra [m]
};
} // namespace dem
