#include "recorder.h"

#include "case_file.h"
#include "checkpoint.h"
#include "errors.h"
#include "summary.h"

#include <algorithm>
#include <cstdio>
#include <omp.h>

namespace spall
{
namespace
{
constexpr std::int64_t preparation_interval = 1000; // steps between rows

std::string history_header()
{
  std::string header;
  for (const SampleColumn &column : sample_columns)
    header += (header.empty() ? "" : ",") + std::string(column.name);
  return header;
}

const char *const events_header =
    "time_s,cycle_1,particle_1,other_1,kind_1,mode_1,force_before_N,"
    "force_after_N,overlap_m,elastic_energy_J,fracture_energy_J,"
    "released_energy_J,removed_volume_m3,kernel_width_rad,depth_m,"
    "ball_radius_m";
const char *const ledger_header =
    "time_s,force_error_1,moment_error_1,power_error_1,membrane_work_J,"
    "plate_work_J,energy_residual_J";

/// Where contact k ends: the centre of stone B, or the point on the wall.
dem::Vec3 end_of(const dem::Engine &engine, const dem::ContactBatch &batch,
                 std::size_t k, dem::ContactKind kind)
{
  const dem::Particles &stones = engine.particles();
  const auto b = static_cast<std::size_t>(batch.b[k]);
  if (kind == dem::ContactKind::stone_stone)
    return stones.position(b);
  const dem::Vec3 &from = stones.position(static_cast<std::size_t>(batch.a[k]));
  if (kind == dem::ContactKind::stone_plane)
  {
    const dem::Plane &plane = engine.planes()[b];
    return from - (from - plane.point).dot(plane.normal) * plane.normal;
  }
  const dem::FacetSpot &spot = engine.facets().spot[k];
  const auto &corner =
      engine.surface().triangles[static_cast<std::size_t>(spot.triangle)];
  dem::Vec3 point = dem::Vec3::Zero();
  for (std::size_t c = 0; c < 3; ++c)
    point += spot.weight[c] *
             engine.surface().position[static_cast<std::size_t>(corner[c])];
  return point;
}

std::vector<dem::ContactLine> contact_lines(const dem::Engine &engine)
{
  std::vector<dem::ContactLine> lines;
  const auto add = [&](const dem::ContactBatch &batch, dem::ContactKind kind)
  {
    for (std::size_t k = 0; k < batch.size(); ++k)
    {
      if (!batch.is_touching(k))
        continue;
      const dem::Vec3 &from =
          engine.particles().position(static_cast<std::size_t>(batch.a[k]));
      const dem::Vec3 to = end_of(engine, batch, k, kind);
      const dem::Vec3 n = (to - from).normalized();
      const dem::Vec3 force =
          kind == dem::ContactKind::stone_stone
              ? dem::pair_force(engine.particles(), batch, k)
              : batch.load[k].force;
      lines.push_back({from, to, -force.dot(n),
                       (force - force.dot(n) * n).norm(), batch.overlap[k],
                       kind});
    }
  };
  add(engine.pairs(), dem::ContactKind::stone_stone);
  add(engine.on_planes(), dem::ContactKind::stone_plane);
  add(engine.on_facets(), dem::ContactKind::stone_facet);
  return lines;
}
} // namespace

Recorder::Recorder(const Case &c, std::filesystem::path run_folder)
    : parameters(c), folder(std::move(run_folder)),
      started(std::chrono::steady_clock::now())
{
}

double Recorder::elapsed() const
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() -
                                       started)
      .count();
}

void Recorder::start()
{
  write_text(folder / "case.prm", resolved_case(parameters));
  history.open(folder / "history.csv", history_header());
  events.open(folder / "events.csv", events_header);
  if (parameters.boundary.lateral == Lateral::membrane)
    ledger.open(folder / "ledger.csv", ledger_header);
}

void Recorder::resume(Triaxial &test)
{
  Progressed done;
  read_checkpoint(folder / "checkpoint" / "state.bin", parameters, test, done);
  write_text(folder / "case.prm", resolved_case(parameters));
  history.resume(folder / "history.csv", done.history_size);
  events.resume(folder / "events.csv", done.events_size);
  if (test.membrane())
    ledger.resume(folder / "ledger.csv", done.ledger_size);
  else if (parameters.boundary.lateral == Lateral::membrane)
    ledger.open(folder / "ledger.csv", ledger_header);
  frames = done.frames;
  n_frames = done.n_frames;
  roundness = done.roundness;
  loading_start = done.loading_start;
  last = done.last;
  worst_balance = done.worst_balance;
  spent_before = done.spent;
  stage_before = std::min(test.stage(), Stage::loading);
}

void Recorder::after_step(Triaxial &test)
{
  const double begun = elapsed();
  note_stage(test);
  if (test.stage() < Stage::loading)
  {
    if (test.stage_steps() % preparation_interval == 0)
      write_history(test);
  }
  else if (test.is_on_tick())
  {
    const std::int64_t n = test.ticks_per_cycle(), step = test.ticks();
    const auto is_due = [&](std::int64_t times)
    { return times > 0 && (step * times) / n != ((step - 1) * times) / n; };
    if (step == 0 || is_due(parameters.output.samples_per_cycle))
    {
      if (step % n == 0)
        roundness = dem::mean_roundness(test.engine().particles());
      write_history(test);
      if (step == 0)
        loading_start = last;
    }
    if (step == 0 || is_due(parameters.output.frames_per_cycle))
      write_frame(test, step == 0 ||
                            parameters.output.surfaces == SurfaceFrames::all);
    const int every = parameters.output.checkpoint_every;
    if (step % n == 0 && every > 0 && (step / n) % every == 0)
      write_checkpoint(test);
  }
  output_seconds += elapsed() - begun;
}

void Recorder::note_stage(Triaxial &test)
{
  if (stage_before == Stage::preparation && test.stage() != Stage::preparation)
  {
    preparation_seconds = elapsed();
    preparation_clock = test.engine().clock();
  }
  stage_before = test.stage();
}

void Recorder::write_history(Triaxial &test)
{
  if (roundness == 0.)
    roundness = dem::mean_roundness(test.engine().particles());
  last = test.sample(roundness);
  std::vector<double> row;
  for (const SampleColumn &column : sample_columns)
    row.push_back(last.*column.value);
  history.write_row(row);
  write_events(test);
  write_ledger(test, last);
}

void Recorder::write_events(Triaxial &test)
{
  const double period = test.period();
  for (const dem::BreakageEvent &e : test.take_events())
  {
    // From times alone, so that it does not matter when the row is written;
    // stones break from the start of loading only.
    const double cycle = std::max(0., (e.time - loading_start.time) / period);
    events.write_row({e.time, cycle, static_cast<double>(e.stone),
                      static_cast<double>(e.other), static_cast<double>(e.kind),
                      static_cast<double>(e.mode), e.force_before,
                      e.force_after, e.overlap, e.elastic_energy,
                      e.fracture_energy, e.released_energy, e.removed_volume,
                      e.width, e.depth, e.ball_radius});
  }
}

void Recorder::write_ledger(Triaxial &test, const Sample &sample)
{
  if (!test.membrane())
    return;
  const coupling::InterfaceBalance balance = test.membrane()->balance();
  worst_balance = std::max({worst_balance, balance.force_error,
                            balance.moment_error, balance.power_error});
  ledger.write_row({sample.time, balance.force_error, balance.moment_error,
                    balance.power_error, test.engine().energy().surface_work,
                    test.plate_work(), sample.energy_residual});
}

void Recorder::write_frame(Triaxial &test, bool with_surfaces)
{
  const dem::Particles &stones = test.engine().particles();
  std::vector<double> loss(stones.size());
  for (std::size_t i = 0; i < loss.size(); ++i)
    loss[i] = 1. - stones.mass(i) / stones.initial_mass[i];
  using dem::StoneState;
  const auto position = stones.column(&StoneState::position),
             velocity = stones.column(&StoneState::velocity),
             spin = stones.column(&StoneState::spin);
  const auto orientation = stones.column(&StoneState::orientation);
  const auto radius = stones.column(&StoneState::radius),
             mass = stones.column(&StoneState::mass);
  const dem::ParticleColumns columns{stones.id, position,    velocity,
                                     spin,      orientation, stones.body,
                                     radius,    mass,        loss};
  const auto name = [this](const char *part)
  {
    char text[64];
    std::snprintf(text, sizeof text, "frames/%s_%05d.vtu", part, n_frames);
    return std::string(text);
  };
  const auto add = [&](int part, const char *label)
  {
    frames.push_back({test.engine().time(), part, name(label)});
    return (folder / frames.back().file).string();
  };
  dem::write_particles(add(0, "particles"), columns);
  dem::write_contacts(add(1, "contacts"), contact_lines(test.engine()));
  if (test.membrane())
    test.membrane()->write_vtu(add(2, "membrane"));
  if (with_surfaces && parameters.output.surfaces != SurfaceFrames::none)
    dem::write_surfaces(add(3, "surfaces"), columns);
  dem::write_collection((folder / "run.pvd").string(), frames);
  ++n_frames;
}

void Recorder::write_checkpoint(Triaxial &test)
{
  write_events(test);
  Progressed done;
  done.history_size = history.flushed_size();
  done.events_size = events.flushed_size();
  if (test.membrane())
    done.ledger_size = ledger.flushed_size();
  done.frames = frames;
  done.n_frames = n_frames;
  done.roundness = roundness;
  done.loading_start = loading_start;
  done.last = last;
  done.worst_balance = worst_balance;
  done.spent = wall_clock(
      test, {elapsed(), output_seconds, preparation_seconds, preparation_clock},
      spent_before);
  spall::write_checkpoint(folder / "checkpoint" / "state.bin", parameters, test,
                          done);
}

void Recorder::finish(Triaxial &test)
{
  const double begun = elapsed();
  if (test.cycle() >= parameters.loading.cycles &&
      parameters.output.surfaces == SurfaceFrames::ends)
    write_frame(test, true);
  write_checkpoint(test);
  output_seconds += elapsed() - begun;
  RunRecord record;
  record.start = loading_start;
  record.end = last;
  record.worst_balance = worst_balance;
  record.threads = omp_get_max_threads();
  record.seconds = wall_clock(
      test, {elapsed(), output_seconds, preparation_seconds, preparation_clock},
      spent_before);
  write_text(folder / "summary.json", summary_text(parameters, test, record));
}

std::string Recorder::last_checkpoint() const
{
  const auto path = folder / "checkpoint" / "state.bin";
  return std::filesystem::exists(path) ? path.string() : "";
}
} // namespace spall
