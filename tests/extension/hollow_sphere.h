#pragma once

#include <dem/boundary/boundary.h>

/// A fixed hollow sphere with particles inside: a bowl. `b` of a contact is the
/// id of its particle.
class HollowSphere final : public dem::Boundary
{
public:
  static constexpr const char *kind_name = "hollow sphere";

  explicit HollowSphere(const dem::WallMaterial &of = {},
                        double its_radius = 1.)
      : Boundary(of), radius(its_radius)
  {
  }

  std::string kind() const override { return kind_name; }
  std::string name_of(std::size_t) const override { return "the bowl"; }
  int event_kind() const override { return 100; }
  void move(double) override {}
  double speed() const override { return 0.; }
  double beyond(const dem::Vec3 &point) const override
  {
    return point.norm() - radius;
  }
  void find_candidates(const dem::BoundarySearch &search) override;
  dem::ForceSum meet(const dem::ForceContext &context) override;
  dem::Walls walls(const dem::ForceContext &) override
  {
    return {material, rows};
  }
  void apply_loads(double time_step) override;
  double work() const override { return 0.; }

  dem::Vec3 force = dem::Vec3::Zero(); ///< of the particles [N]

private:
  void pack_parts(std::ostream &out) const override;
  void unpack_parts(std::istream &in) override;

  double radius; ///< about the origin [m]
  std::vector<dem::WallRow> rows;
};
