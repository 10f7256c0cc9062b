#include "bench/report.h"
#include "commands/commands.h"
#include "errors.h"
#include "run/whole_file.h"
#include "shape/file.h"
#include "specimen/specimen.h"

#include <dem/measure/assembly.h>
#include <dem/parallel/distribution.h>
#include <dem/parallel/mpi_ranks.h>
#include <dem/stopwatch.h>

#include <charconv>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <map>
#include <omp.h>

namespace spall
{
namespace
{
struct BenchOptions
{
  std::string packing, shapes, json, save;
  std::string scene = "rest", geometry = "radial";
  int steps = 1000, threads = 1, repeat = 1;
  int settle = -1; ///< -1: as the scene needs
  int copies = 1;  ///< of the closed packing, along each axis
  bool is_breaking = false;
};

const std::map<std::string, BenchScene> scenes = {
    {"rest", BenchScene::rest},
    {"jolt", BenchScene::jolt},
    {"collapse", BenchScene::collapse}};

const std::map<std::string, dem::ContactGeometry> geometries = {
    {"sphere", dem::ContactGeometry::sphere},
    {"radial", dem::ContactGeometry::radial},
    {"surface", dem::ContactGeometry::surface}};

int whole_number(const std::string &option, const std::string &text, int least)
{
  int value = 0;
  const auto [end, status] =
      std::from_chars(text.data(), text.data() + text.size(), value);
  if (status != std::errc{} || end != text.data() + text.size() ||
      value < least)
    throw InputError("bench: " + option + " " + text +
                     ": must be a whole number from " + std::to_string(least) +
                     " up");
  return value;
}

/// A file that is written after minutes of work must not fail for its name.
void require_folder(const std::string &option, const std::string &path)
{
  const auto folder = std::filesystem::path(path).parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder))
    throw InputError("bench: " + option + " " + path +
                     ": cannot be written, no folder " + folder.string());
}

void check(const BenchOptions &options)
{
  if (options.packing.empty())
    throw InputError("bench: --packing P.csv must be given");
  if (!scenes.contains(options.scene))
    throw InputError("bench: --scene " + options.scene +
                     ": must be rest, jolt or collapse");
  if (!geometries.contains(options.geometry))
    throw InputError("bench: --geometry " + options.geometry +
                     ": must be sphere, radial or surface");
  if (options.threads > most_threads)
    throw InputError("bench: --threads " + std::to_string(options.threads) +
                     ": must be at most " + std::to_string(most_threads));
  if (options.is_breaking && options.shapes.empty())
    throw InputError("bench: --breakage: needs --shapes DIR, spheres do not "
                     "break");
  if (options.copies > 1 && options.shapes.empty())
    throw InputError("bench: --copies " + std::to_string(options.copies) +
                     ": needs --shapes DIR, a lattice of spheres is made in "
                     "any size");
  require_folder("--json", options.json);
  require_folder("--save", options.save);
}

BenchOptions bench_options(Words words)
{
  BenchOptions options;
  const std::map<std::string, std::string *> texts = {
      {"--packing", &options.packing}, {"--shapes", &options.shapes},
      {"--scene", &options.scene},     {"--geometry", &options.geometry},
      {"--json", &options.json},       {"--save", &options.save}};
  const std::map<std::string, int *> counts = {{"--steps", &options.steps},
                                               {"--threads", &options.threads},
                                               {"--repeat", &options.repeat},
                                               {"--settle", &options.settle},
                                               {"--copies", &options.copies}};
  for (std::size_t k = 0; k < words.size(); ++k)
  {
    const std::string &word = words[k];
    const bool is_text = texts.contains(word), is_count = counts.contains(word);
    if (word == "--breakage")
      options.is_breaking = true;
    else if (!is_text && !is_count)
      throw InputError("bench: " + word +
                       ": must be one of --packing, --steps, --threads, "
                       "--shapes, --geometry, --breakage, --scene, --repeat, "
                       "--json, --settle, --copies, --save");
    else if (k + 1 == words.size() || words[k + 1].empty())
      throw InputError("bench: " + word + ": a value must follow");
    else if (is_text)
      *texts.at(word) = words[++k];
    else
    {
      *counts.at(word) =
          whole_number(word, words[k + 1], word == "--settle" ? 0 : 1);
      ++k;
    }
  }
  check(options);
  return options;
}

/// State of the engine when the timed steps begin.
void describe(const dem::Engine &engine, BenchResult &result)
{
  result.n_breakable = count_breakable(engine);
  result.coordination = dem::contact_network(engine).coordination_number;
  result.unbalanced_ratio = dem::unbalanced_force_ratio(engine);
}

/// Builds the scene again and times it; every repeat does the same.
void time_once(const BenchOptions &options, const BenchParticles &particles,
               BenchResult &result)
{
  const BenchScene scene = scenes.at(options.scene);
  const auto engine = make_bench_engine(particles, scene, options.is_breaking);
  const MemoryUse built = memory_use();
  settle(*engine, scene,
         options.settle < 0 ? settling_steps(scene) : options.settle);
  for (int step = 0; step < warm_up_steps; ++step)
    engine->advance_deferred(bench_step);
  engine->synchronize();
  const bool is_first = result.samples.empty();
  if (is_first)
    describe(*engine, result);
  result.samples.push_back(measure(*engine, options.steps, bench_step));
  if (!is_first)
    return;
  result.built = built;
  result.run = memory_use();
}

/// A line every ten seconds.
class ClosingProgress
{
public:
  void operator()(const ClosedBox &reached)
  {
    constexpr double interval = 10.; // [s]
    if (since.seconds() < interval)
      return;
    since = dem::Stopwatch();
    std::printf("closing %.4f s, step %lld, stress %.3g Pa, unbalanced force "
                "ratio %.2g\n",
                reached.time, static_cast<long long>(reached.n_steps),
                reached.stress.mean(), reached.unbalanced_ratio);
    std::fflush(stdout);
  }

private:
  dem::Stopwatch since;
};

/// Rows of a packing take the shapes in turn: those of a copy must be the same.
void check_copies(const BenchOptions &options, const Packing &packing)
{
  const std::size_t n_shapes = read_shapes(options.shapes).size();
  if (packing.size() % n_shapes != 0)
    throw InputError("bench: --copies " + std::to_string(options.copies) +
                     ": the " + std::to_string(packing.size()) +
                     " particles of " + options.packing +
                     " must be a multiple of the " + std::to_string(n_shapes) +
                     " shapes of " + options.shapes);
}

BenchParticles prepare(const BenchOptions &options, BenchResult &result)
{
  Packing packing = read_packing(options.packing);
  const bool is_closed = !packing.orientation.empty();
  const bool is_joined = options.copies > 1;
  if (is_joined)
    check_copies(options, packing);
  BenchParticles particles =
      make_bench_particles(std::move(packing), options.shapes);
  particles.geometry = geometries.at(options.geometry);
  particles.ranks = dem::ranks_of_program();
  const bool needs_closing = !options.shapes.empty() && !is_closed;
  if (particles.ranks->size() > 1 && (needs_closing || is_joined))
    throw InputError("bench: --packing " + options.packing +
                     ": must be closed round the shapes first, on one rank "
                     "with --save P.csv");
  if (needs_closing)
  {
    std::cout << "closing the box round " << particles.packing.size()
              << " particles ..." << std::endl;
    result.closed = close_box(particles, ClosingProgress());
  }
  if (is_joined)
  {
    std::cout << "joining " << options.copies << " copies along each axis ..."
              << std::endl;
    result.closed = join_copies(particles, options.copies, ClosingProgress());
  }
  if (!options.save.empty() && particles.ranks->rank() == 0)
    write_packing(options.save, particles.packing);
  return particles;
}
} // namespace

int bench_command(Words words)
{
  const BenchOptions options = bench_options(words);
  omp_set_num_threads(options.threads);
  BenchResult result;
  const BenchParticles particles = prepare(options, result);
  for (const dem::ParticleShape &body : particles.bodies)
    result.solid_fraction += body.volume / particles.packing.box.prod();
  result.packing = std::filesystem::path(options.packing).filename().string();
  result.scene = options.scene;
  result.geometry = options.shapes.empty() ? "sphere" : options.geometry;
  result.n_particles = particles.packing.size();
  result.threads = options.threads;
  result.is_breaking = options.is_breaking;
  result.box = particles.packing.box;
  result.before = memory_use();
  for (int repeat = 0; repeat < options.repeat; ++repeat)
    time_once(options, particles, result);
  const bool is_first = particles.ranks->rank() == 0;
  if (is_first)
    std::cout << bench_text(result);
  if (is_first && !options.json.empty())
    write_asked(options.json, bench_json(result));
  return result.is_reproducible() ? 0 : 2;
}
} // namespace spall
