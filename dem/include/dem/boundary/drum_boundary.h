#pragma once

#include <dem/boundary/boundary.h>
#include <dem/boundary/drum.h>
#include <dem/boundary/drum_lifter.h>
#include <dem/boundary/followed_walls.h>
#include <dem/neighbor/candidate_pair.h>

#include <array>

namespace dem
{
/// The drum of a scene, or the side of an upright cylinder; `b` of a contact is
/// as drum_part() reads it.
class DrumBoundary final : public Boundary
{
public:
  static constexpr const char *kind_name = "drum";

  explicit DrumBoundary(const WallMaterial &of = {}) : Boundary(of) {}

  /// Its lists must be rebuilt: Engine::lists_changed().
  void set_drum(const Drum &its_drum);

  std::string kind() const override { return kind_name; }
  std::string name_of(std::size_t) const override { return "the drum"; }
  int evaluation_order() const override { return 1; }
  int event_kind() const override { return 3; }
  void move(double time_step) override;
  double speed() const override;
  double beyond(const Vec3 &point) const override;
  void find_candidates(const BoundarySearch &search) override;
  bool can_be_shared() const override { return true; }
  std::vector<CandidatePair> *candidates() override { return &listed; }
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
  double work() const override { return drum.work; }

  Drum drum; ///< its spin and widening may change at any time

private:
  FollowedDrum followed() { return {drum, lifter, rows, overlap}; }
  void book(double time_step);
  void pack_parts(std::ostream &out) const override;
  void unpack_parts(std::istream &in) override;

  DrumLifter lifter;                 ///< where `drum` stands
  std::vector<CandidatePair> listed; ///< of true surfaces, sorted
  std::uint8_t was_searched = 0;     ///< by true surfaces
  std::vector<WallRow> rows;         ///< those of the last step are read
  std::vector<double> overlap;
  std::array<ExactSum, 2> load_sums; ///< torque [N m], thrust [N]
};
} // namespace dem
