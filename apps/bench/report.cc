#include "bench/report.h"

#include "run/digest.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cinttypes>
#include <cstdarg>
#include <cstdio>
#include <limits>

namespace spall
{
namespace
{
using Json = nlohmann::ordered_json;

/// A line of the table: what, and a printf format with its values.
[[gnu::format(printf, 2, 3)]] std::string line(const char *what,
                                               const char *format, ...)
{
  std::array<char, 200> value{};
  std::va_list values;
  va_start(values, format);
  std::vsnprintf(value.data(), value.size(), format, values);
  va_end(values);
  std::array<char, 20> label{};
  std::snprintf(label.data(), label.size(), "%-16s ", what);
  return std::string(label.data()) + value.data() + "\n";
}

/// Memory of the scene; not known if the box was closed before it, since that
/// leaves freed memory behind.
double per_particle(const BenchResult &result, double bytes)
{
  if (result.closed)
    return std::numeric_limits<double>::quiet_NaN();
  return (bytes - result.before.now) / static_cast<double>(result.n_particles);
}

/// Change of the energy residual over the timed steps [J].
double residual_change(const BenchSample &sample)
{
  return energy_residual(sample.energy_after) -
         energy_residual(sample.energy_before);
}

std::string scene_text(const BenchResult &r)
{
  std::string text =
      line("packing", "%s", r.packing.c_str()) +
      line("scene", "%s, %s%s, %d thread%s", r.scene.c_str(),
           r.geometry.c_str(), r.is_breaking ? ", breakage on" : "", r.threads,
           r.threads > 1 ? "s" : "") +
      line("particles", "%zu, %zu breakable", r.n_particles, r.n_breakable) +
      line("box", "%.4g x %.4g x %.4g m, solid fraction %.3f", r.box.x(),
           r.box.y(), r.box.z(), r.solid_fraction);
  if (r.closed)
    text += line("closed",
                 "%.3g %.3g %.3g kPa, unbalanced force ratio %.2g "
                 "after %" PRId64 " steps of %.3g s",
                 1e-3 * r.closed->stress.x(), 1e-3 * r.closed->stress.y(),
                 1e-3 * r.closed->stress.z(), r.closed->unbalanced_ratio,
                 r.closed->n_steps, r.closed->step);
  text += line("packed",
               "coordination number %.3f, unbalanced force ratio "
               "%.2g",
               r.coordination, r.unbalanced_ratio);
  return text;
}

std::string sample_text(const BenchSample &s)
{
  const double updates = s.updates();
  return line("touching pairs",
              "%" PRId64 " -> %" PRId64 " of %" PRId64 " listed",
              s.before.pairs, s.after.pairs, s.after.listed) +
         line("touching walls", "%" PRId64 " -> %" PRId64, s.before.walls,
              s.after.walls) +
         line("steps",
              "%d of %.3g s, %" PRId64 " rebuilds, %" PRId64 " breakage events",
              s.n_steps, bench_step, s.n_rebuilds, s.n_events) +
         line("wall, CPU", "%.4f s, %.4f s", s.wall, s.cpu) +
         line("speed", "%.1f steps/s", s.n_steps / s.wall) +
         line("contact updates",
              "%.3f million per CPU second, %.3f per wall "
              "second",
              1e-6 * updates / s.cpu, 1e-6 * updates / s.wall) +
         line("each", "%.1f ns of CPU time", 1e9 * s.cpu / updates) +
         line(
             "phases",
             "contacts %.1f %%, search %.1f %%, breakage %.1f %%, motion "
             "%.1f %%, exchange %.1f %%",
             100. * s.phases.contacts / s.wall, 100. * s.phases.search / s.wall,
             100. * s.phases.breakage / s.wall, 100. * s.phases.motion / s.wall,
             100. * s.phases.exchange / s.wall) +
         (s.share.n_ranks == 1
              ? ""
              : line("ranks",
                     "%d, ghosts %.0f each, %.0f at most, %.1f kB per step at "
                     "most, imbalance %.3f",
                     s.share.n_ranks, s.share.mean_ghosts, s.share.most_ghosts,
                     1e-3 * s.share.most_bytes, s.share.imbalance));
}

std::string energy_text(const BenchSample &s)
{
  const dem::EngineEnergy &a = s.energy_before, &b = s.energy_after;
  return line("kinetic", "%.4g -> %.4g J", a.kinetic, b.kinetic) +
         line("elastic", "%.4g -> %.4g J", a.elastic, b.elastic) +
         line("dissipated", "friction %.3g, rolling %.3g, damping %.3g J",
              b.friction - a.friction, b.rolling - a.rolling,
              b.damping - a.damping) +
         line("residual", "%.3g J in the timed steps", residual_change(s));
}

Json energy_json(const dem::EngineEnergy &e)
{
  return {{"kinetic_J", e.kinetic},
          {"elastic_J", e.elastic},
          {"friction_J", e.friction},
          {"rolling_J", e.rolling},
          {"damping_J", e.damping},
          {"breakage_J", e.breakage},
          {"non_conservative_work_J", e.non_conservative_work},
          {"plane_work_J", e.work_of("planes")},
          {"gravity_work_J", e.gravity_work},
          {"residual_J", energy_residual(e)}};
}

Json sample_json(const BenchSample &s)
{
  const double updates = s.updates();
  return {{"steps", s.n_steps},
          {"wall_s", s.wall},
          {"cpu_s", s.cpu},
          {"steps_per_s", s.n_steps / s.wall},
          {"pairs_before", s.before.pairs},
          {"pairs_after", s.after.pairs},
          {"walls_before", s.before.walls},
          {"walls_after", s.after.walls},
          {"listed_pairs", s.after.listed},
          {"updates", updates},
          {"updates_per_cpu_s", updates / s.cpu},
          {"updates_per_wall_s", updates / s.wall},
          {"cpu_ns_per_update", 1e9 * s.cpu / updates},
          {"rebuilds", s.n_rebuilds},
          {"events", s.n_events},
          {"phases_s",
           {{"contacts", s.phases.contacts},
            {"search", s.phases.search},
            {"breakage", s.phases.breakage},
            {"motion", s.phases.motion},
            {"exchange", s.phases.exchange}}},
          {"ranks", s.share.n_ranks},
          {"mean_ghosts", s.share.mean_ghosts},
          {"most_ghosts", s.share.most_ghosts},
          {"most_bytes_per_step", s.share.most_bytes},
          {"imbalance_1", s.share.imbalance},
          {"energy_before", energy_json(s.energy_before)},
          {"energy_after", energy_json(s.energy_after)},
          {"checksum", hex_text(s.checksum)}};
}
} // namespace

const BenchSample &BenchResult::median() const
{
  std::vector<const BenchSample *> sorted;
  for (const BenchSample &sample : samples)
    sorted.push_back(&sample);
  std::ranges::sort(sorted, {}, [](const BenchSample *s) { return s->cpu; });
  return *sorted[(sorted.size() - 1) / 2];
}

bool BenchResult::is_reproducible() const
{
  return std::ranges::all_of(samples,
                             [this](const BenchSample &s) {
                               return s.checksum == samples.front().checksum;
                             });
}

std::string bench_text(const BenchResult &r)
{
  const BenchSample &s = r.median();
  std::string text = scene_text(r) + sample_text(s);
  if (r.samples.size() > 1)
  {
    const auto [least, most] = std::ranges::minmax_element(
        r.samples, {}, [](const BenchSample &sample) { return sample.cpu; });
    text += line("repeats", "%zu, this is the median; CPU %.4f to %.4f s%s",
                 r.samples.size(), least->cpu, most->cpu,
                 r.is_reproducible() ? "" : ", NOT THE SAME BITS");
  }
  return text + energy_text(s) +
         line("memory", "%.1f MB before, %.1f built, %.1f run, %.1f peak",
              1e-6 * r.before.now, 1e-6 * r.built.now, 1e-6 * r.run.now,
              1e-6 * r.run.peak) +
         (r.closed
              ? line("per particle", "not known: the box was closed")
              : line("per particle", "%.0f bytes built, %.0f run, %.0f peak",
                     per_particle(r, r.built.now), per_particle(r, r.run.now),
                     per_particle(r, r.run.peak))) +
         line("checksum", "%s", hex_text(s.checksum).c_str());
}

std::string bench_json(const BenchResult &r)
{
  Json out = {{"packing", r.packing},
              {"scene", r.scene},
              {"geometry", r.geometry},
              {"breakage", r.is_breaking},
              {"threads", r.threads},
              {"particles", r.n_particles},
              {"breakable", r.n_breakable},
              {"box_m", {r.box.x(), r.box.y(), r.box.z()}},
              {"solid_fraction_1", r.solid_fraction},
              {"coordination_1", r.coordination},
              {"unbalanced_force_ratio_1", r.unbalanced_ratio},
              {"time_step_s", bench_step}};
  if (r.closed)
    out["closed"] = {
        {"stress_Pa",
         {r.closed->stress.x(), r.closed->stress.y(), r.closed->stress.z()}},
        {"unbalanced_force_ratio_1", r.closed->unbalanced_ratio},
        {"steps", r.closed->n_steps},
        {"time_step_s", r.closed->step}};
  out["memory_bytes"] = {{"before", r.before.now},
                         {"built", r.built.now},
                         {"run", r.run.now},
                         {"peak", r.run.peak},
                         {"per_particle_built", per_particle(r, r.built.now)},
                         {"per_particle_run", per_particle(r, r.run.now)},
                         {"per_particle_peak", per_particle(r, r.run.peak)}};
  out["reproducible"] = r.is_reproducible();
  out["median"] = sample_json(r.median());
  for (const BenchSample &sample : r.samples)
    out["samples"].push_back(sample_json(sample));
  return out.dump(2) + "\n";
}
} // namespace spall
