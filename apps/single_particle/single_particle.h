#pragma once

#include "test/test.h"

namespace spall
{
/// One particle between two rigid platens. The lower one stands, the upper one
/// comes down at constant speed; both touch the particle at the start.
class SingleParticle : public Test
{
public:
  /// Throws InputError.
  explicit SingleParticle(const Case &parameters);

  double share_done() const override;
  double duration() const override;
  std::string phase() const override;
  std::string outcome() const override;
  Due due() const override;
  double progress_at(double time) const override; ///< displacement [m]
  const char *progress_column() const override { return "displacement_m"; }
  void summarise(nlohmann::ordered_json &summary) const override;
  void save(std::ostream &out, dem::StateExtent extent) const override;
  void restore(std::istream &in) override;
  std::vector<NamedBoundary> named_boundaries() const override;

private:
  SingleParticle(const Case &parameters, const ShapeLibrary &library);
  void move(double time_step) override;
  std::vector<Quantity> measured() const override;
  double force() const; ///< on the upper platen, up [N]
  double force_on(const std::string &name) const;
  std::size_t plane_of(const std::string &name) const;

  double height = 0.;              ///< of the particle between platens [m]
  double peak_force = 0.;          ///< [N]
  double displacement_before = 0.; ///< at the last step [m]
  std::int64_t events_before = 0, events_now = 0;
};
} // namespace spall
