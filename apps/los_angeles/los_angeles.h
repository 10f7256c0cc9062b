#pragma once

#include "test/test.h"

#include <dem/measure/roundness_book.h>

namespace spall
{
/// The Los Angeles test: particles and steel balls fall into a drum at rest,
/// then it turns. Breakage counts from the first turn.
class LosAngeles : public Test
{
public:
  /// Throws InputError.
  explicit LosAngeles(const Case &parameters);

  double share_done() const override;
  double duration() const override;
  double period() const override; ///< of a turn [s]
  FastPreparation fast_preparation() override;
  std::string phase() const override;
  std::string outcome() const override;
  std::vector<std::string> warnings() const override;
  Due due() const override;
  FrameParts frame_parts() const override;
  std::vector<NamedText> take_files() override;
  double progress_at(double time) const override; ///< turns [-]
  const char *progress_column() const override { return "turn_1"; }
  void summarise(nlohmann::ordered_json &summary) const override;
  void stop_after(int turns) override;
  bool ends_early() const override { return last_turn < parameters.drum.turns; }
  void save(std::ostream &out, dem::StateExtent extent) const override;
  void restore(std::istream &in) override;
  std::vector<NamedBoundary> named_boundaries() const override
  {
    return {{"drum", BoundaryKind::drum}};
  }

private:
  struct Scene;
  LosAngeles(const Case &parameters, Scene scene);
  void move(double time_step) override;
  std::vector<Quantity> measured() const override;
  double turns() const; ///< so far [-]
  bool is_settled();
  void begin_turning();
  std::vector<std::string> unrest_warnings() const;
  void store_roundness();

  double last_turn = 0.;    ///< of this run [-]
  double start_time = 0.;   ///< of the first turn [s]
  double turns_before = 0.; ///< at the last step [-]
  bool is_turning = false;
  bool is_rough = false; ///< of a forecast: rest is not required
  double unrest = 0.;    ///< unbalanced weight ratio when it began to turn [-]
  mutable dem::RoundnessBook roundness;
  std::vector<NamedText> files;
};
} // namespace spall
