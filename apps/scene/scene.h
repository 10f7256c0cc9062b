#pragma once

#include "scene/builder.h"
#include "test/test.h"

namespace spall
{
/// Particles, walls and gravity: the scene of the case, followed for its
/// duration.
class Scene : public Test
{
public:
  /// Throws InputError.
  explicit Scene(const Case &parameters);

  double share_done() const override;
  double duration() const override { return own.scene.duration; }
  std::string phase() const override;
  std::string outcome() const override;
  Due due() const override;
  double frame_interval() const override;
  FrameParts frame_parts() const override;
  double progress_at(double time) const override { return time; }
  const char *progress_column() const override { return "time_s"; }
  void summarise(nlohmann::ordered_json &summary) const override;
  void save(std::ostream &out, dem::StateExtent extent) const override;
  void restore(std::istream &in) override;
  std::vector<NamedBoundary> named_boundaries() const override;
  /// With what the particles have as placed as work: motion, and springs of
  /// contacts that overlap.
  EnergyBalance energy_balance() const override;

private:
  Scene(const Case &parameters, const PlacedParticles &particles);
  Scene(const Case &parameters, const PlacedParticles &particles,
        const SceneStart &as_placed, BuiltScene built);
  void move(double time_step) override;
  std::vector<Quantity> measured() const override;

  SceneCase own;
  SceneStart start;
  std::vector<BoxPlane> box;
  double time_before = 0.;      ///< at the last step [s]
  std::uint8_t is_breaking = 0; ///< breakage counts
};
} // namespace spall
