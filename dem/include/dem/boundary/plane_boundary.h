#pragma once

#include <dem/boundary/boundary.h>
#include <dem/boundary/plane.h>
#include <dem/neighbor/candidate_pair.h>

namespace dem
{
/// The planes of a scene; `b` of a contact is the plane.
class PlaneBoundary final : public Boundary
{
public:
  static constexpr const char *kind_name = "planes";

  explicit PlaneBoundary(const WallMaterial &of = {}) : Boundary(of) {}

  std::string kind() const override { return kind_name; }
  std::string name_of(std::size_t k) const override;
  int evaluation_order() const override { return 0; }
  int event_kind() const override { return 1; }
  std::int64_t event_other(std::size_t k) const override { return batch.b[k]; }
  void move(double time_step) override;
  double speed() const override;
  double beyond(const Vec3 &point) const override;
  void find_candidates(const BoundarySearch &search) override;
  ForceSum meet(const ForceContext &context) override;
  Walls walls(const ForceContext &) override { return {material, rows}; }
  BoundarySums sum_loads(const SumGrid &grid) override;
  bool can_be_shared() const override { return true; }
  std::vector<CandidatePair> *candidates() override { return &supports; }
  void apply_loads(double time_step) override;
  double work() const override;

  std::vector<Plane> planes;

private:
  /// Sum of loads and of their sizes [N]: the first is exact in double as long
  /// as the second is small, see SumGrid::largest_sum.
  struct LoadSum
  {
    Vec3 force = Vec3::Zero(), size = Vec3::Zero();
  };

  void add_force(const Vec3 &force, std::size_t plane);
  void pack_parts(std::ostream &out) const override;
  void unpack_parts(std::istream &in) override;

  std::vector<CandidatePair> supports; ///< of true surfaces, sorted
  std::vector<WallRow> rows;
  std::vector<LoadSum> load_sums;   ///< by plane, space to work in
  std::vector<ExactSum> force_sums; ///< on the planes, by component [N]
};
} // namespace dem
