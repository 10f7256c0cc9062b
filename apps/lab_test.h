#pragma once

#include "case.h"
#include "frames.h"
#include "specimen.h"
#include "step_watch.h"

#include <nlohmann/json_fwd.hpp>

#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

namespace spall
{
/// What is due after a step.
struct Due
{
  bool row = false, frame = false, checkpoint = false;
};

/// One column of history.csv with its value in this row.
struct Quantity
{
  const char *name; ///< name_unit
  double value = 0.;
};

/// A test with stones and what is around them, step by step: what the single
/// particle, the Los Angeles drum and the subgrade have in common.
class LabTest
{
public:
  virtual ~LabTest() = default;
  LabTest(const LabTest &) = delete;
  LabTest &operator=(const LabTest &) = delete;

  /// One step, or the steps of a window.
  void advance();
  /// Share of the whole test that is done; 1: it is over [-].
  virtual double share_done() const = 0;
  /// Of the whole test [s].
  virtual double duration() const = 0;
  /// Where it is, in a few words.
  virtual std::string phase() const = 0;
  virtual Due due() const = 0;

  /// How far the test was at a time, in the unit of its column of events.csv.
  virtual double progress_at(double time) const = 0;
  virtual const char *progress_column() const = 0;

  /// The row of history.csv now: what the test measures, then counts and
  /// energies.
  std::vector<Quantity> row() const;
  /// Adds what summary.json says of this test.
  virtual void summarise(nlohmann::ordered_json &summary) const;
  /// Ends after so many turns, whatever the case says. Throws InputError for a
  /// test that has none.
  virtual void stop_after(int turns);

  virtual void save(std::ostream &out) const; ///< full state, bit for bit
  /// Continues a saved test of the same case; throws std::runtime_error.
  virtual void restore(std::istream &in);

  /// Stones and the bodies around them; null: there are none.
  virtual const coupling::Exchange *exchange() const { return nullptr; }
  /// Gain of the exchange now [-].
  virtual double exchange_gain() const { return 0.; }
  /// Bodies that a frame shows.
  virtual std::vector<FrameBody> frame_bodies() const { return {}; }
  /// Tables that are written when the test ends.
  virtual void write_tables(const std::filesystem::path &) const {}

  /// Breakage events since the last call.
  std::vector<dem::BreakageEvent> take_events();
  const dem::Engine &engine() const { return *stones; }
  dem::Engine &engine() { return *stones; }
  double time_step() const { return step; } ///< last or next one [s]
  /// Lines for the log since the last call.
  std::vector<std::string> take_notes() { return watch.take_notes(); }
  double watch_seconds() const { return watch.seconds(); }
  /// Abrasion of the stones, those of other materials left out [%].
  double abrasion_percent() const;

protected:
  /// Takes the scene; the engine has all its stones.
  LabTest(const Case &parameters, ShapeLibrary shapes,
          std::unique_ptr<dem::Engine> scene);

  /// The boundaries take their speed and the engine a step.
  virtual void move(double time_step) = 0;
  virtual std::vector<Quantity> measured() const = 0;
  /// Done by gravity and boundaries on the stones [J].
  virtual double external_work() const;
  /// Of the bodies around the stones.
  virtual coupling::BodyEnergy bodies() const { return {}; }
  virtual std::vector<dem::BreakageEvent> new_events();
  /// What the watch looks at besides the stones.
  virtual Surroundings surroundings() const { return {}; }
  /// Of the engine in one move().
  virtual int steps_in_move() const { return 1; }
  const ShapeLibrary &library() const { return shapes; }

  Case parameters;

private:
  ShapeLibrary shapes;
  std::unique_ptr<dem::Engine> stones;
  StepWatch watch;
  double step = 0.;                                      ///< [s]
  double first_event_time = -1., first_event_force = 0.; ///< [s], [N]
};

/// The scene of a single_particle, los_angeles or subgrade case. Throws
/// InputError.
std::unique_ptr<LabTest> make_lab_test(const Case &parameters);
} // namespace spall
