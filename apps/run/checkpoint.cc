#include "run/checkpoint.h"

#include "case/file.h"
#include "case/parameter.h"
#include "errors.h"
#include "run/binary_text.h"
#include "run/digest.h"
#include "run/digested.h"
#include "run/whole_file.h"

#include <dem/binary.h>

#include <fstream>
#include <sstream>

namespace spall
{
namespace
{
constexpr std::uint64_t magic = state_layout;

using dem::read_value;
using dem::write_value;

/// The case without what may change between stop and restart.
std::string identity_of(Case parameters)
{
  const Case defaults;
  parameters.threads = defaults.threads;
  parameters.loading.cycles = defaults.loading.cycles;
  parameters.coupling.ledger_limit = defaults.coupling.ledger_limit;
  parameters.coupling.rules.gap_limit = defaults.coupling.rules.gap_limit;
  parameters.contact.overlap = defaults.contact.overlap;
  parameters.loading.consolidation_max_time =
      defaults.loading.consolidation_max_time;
  parameters.plate.seating_max_time = defaults.plate.seating_max_time;
  parameters.time.allow_unstable_step = defaults.time.allow_unstable_step;
  parameters.output = defaults.output;
  parameters.drum.turns = defaults.drum.turns;
  parameters.drum.rows_per_turn = defaults.drum.rows_per_turn;
  parameters.drum.frames_per_turn = defaults.drum.frames_per_turn;
  parameters.drum.checkpoint_every = defaults.drum.checkpoint_every;
  parameters.vibration.duration = defaults.vibration.duration;
  parameters.vibration.reports = defaults.vibration.reports;
  parameters.vibration.rows_per_period = defaults.vibration.rows_per_period;
  parameters.vibration.frames_per_second = defaults.vibration.frames_per_second;
  parameters.vibration.checkpoint_every = defaults.vibration.checkpoint_every;
  parameters.press.rows = defaults.press.rows;
  RecordParameters &record = parameters.subgrade.record;
  const RecordParameters any;
  record.row_interval = any.row_interval;
  record.frame_interval = any.frame_interval;
  record.checkpoint_interval = any.checkpoint_interval;
  record.highest_frequency = any.highest_frequency;
  if (parameters.kind == CaseKind::dynamic_triaxial)
  {
    // Steps may change where a cycle ends: Triaxial::restore() looks.
    const double local_damping = parameters.time.local_damping;
    parameters.time = defaults.time;
    parameters.time.local_damping = local_damping;
  }
  parameters.title = defaults.title;
  // A mesh counts by what is in its file alone.
  parameters.subgrade.ground.mesh.clear();
  parameters.boundary.mesh.clear();
  std::string text = without_comments(parameters_as_run(parameters));
  for (const auto &[name, digest] : parameters.contents)
    text += "contents of " + name + " = " + hex_text(digest) + "\n";
  return text;
}

/// First line that differs, for the message.
std::string first_difference(const std::string &then, const std::string &now)
{
  std::istringstream a(then), b(now);
  std::string line_a, line_b;
  while (std::getline(a, line_a) && std::getline(b, line_b))
    if (line_a != line_b)
      return "was '" + line_a + "', is '" + line_b + "'";
  return "different length";
}

void read_progress(std::istream &in, Progressed &done)
{
  for (std::uint64_t *size :
       {&done.history_size, &done.events_size, &done.ledger_size})
    read_value(in, *size);
  read_value(in, done.n_frames);
  std::uint64_t n = 0;
  read_value(in, n);
  for (std::uint64_t k = 0; k < n; ++k)
  {
    dem::FrameEntry &entry = done.frames.emplace_back();
    read_value(in, entry.time);
    read_value(in, entry.part);
    entry.file = read_text(in);
  }
  read_value(in, done.roundness);
  read_value(in, done.worst_gain);
  read_value(in, done.peak_axial_stress);
  read_value(in, done.loading_start);
  read_value(in, done.last);
  read_value(in, n);
  for (std::uint64_t k = 0; k < n; ++k)
  {
    const std::string phase = read_text(in);
    read_value(in, done.spent[phase]);
  }
}

void write_progress(std::ostream &out, const Progressed &done)
{
  for (const std::uint64_t size :
       {done.history_size, done.events_size, done.ledger_size})
    write_value(out, size);
  write_value(out, done.n_frames);
  write_value(out, static_cast<std::uint64_t>(done.frames.size()));
  for (const dem::FrameEntry &entry : done.frames)
  {
    write_value(out, entry.time);
    write_value(out, entry.part);
    write_text(out, entry.file);
  }
  write_value(out, done.roundness);
  write_value(out, done.worst_gain);
  write_value(out, done.peak_axial_stress);
  write_value(out, done.loading_start);
  write_value(out, done.last);
  write_value(out, static_cast<std::uint64_t>(done.spent.size()));
  for (const auto &[phase, seconds] : done.spent)
  {
    write_text(out, phase);
    write_value(out, seconds);
  }
}
} // namespace

void write_checkpoint(const std::filesystem::path &path, const Case &parameters,
                      const std::function<void(std::ostream &)> &save,
                      const Progressed &done)
{
  const auto write = [&](std::ostream &out)
  {
    write_value(out, magic);
    write_text(out, identity_of(parameters));
    write_progress(out, done);
    save(out);
  };
  write_whole(
      path, [&write](std::ostream &file) { write_digested(file, write); },
      Durability::on_disk);
}

bool is_of_this_version(const std::filesystem::path &path)
{
  std::ifstream in(path, std::ios::binary);
  std::uint64_t mark = 0;
  in.read(reinterpret_cast<char *>(&mark), sizeof mark);
  return in && mark == magic;
}

void require_checkpoint(const std::filesystem::path &path)
{
  if (!std::ifstream(path, std::ios::binary))
    throw InputError("--resume: no checkpoint " + path.string() +
                     ": start the run without --resume");
}

void refuse_shorter(const char *key, double done, double asked)
{
  if (done > asked * (1. + 1e-3))
    throw std::runtime_error("has come to " + number_text(done) + " where " +
                             key + " is " + number_text(asked) +
                             ": must be no less");
}

void read_checkpoint(const std::filesystem::path &path, const Case &parameters,
                     const std::function<void(std::istream &)> &restore,
                     Progressed &done)
{
  require_checkpoint(path);
  std::ifstream in(path, std::ios::binary);
  try
  {
    std::uint64_t mark = 0;
    read_value(in, mark);
    if (mark != magic)
      throw std::runtime_error("not a checkpoint of this version");
    if (!is_as_digested(path))
      throw std::runtime_error("checkpoint is damaged");
    if (const std::string then = read_text(in), now = identity_of(parameters);
        then != now)
      throw std::runtime_error("is of another case: " +
                               first_difference(then, now));
    read_progress(in, done);
    restore(in);
  }
  catch (const std::runtime_error &error)
  {
    throw InputError("--resume: " + path.string() + ": " + error.what());
  }
}
} // namespace spall
