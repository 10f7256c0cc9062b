#include "shape/generate.h"

#include "errors.h"
#include "shape/file.h"

#include <dem/shape/form.h>
#include <dem/shape/generate.h>
#include <dem/shape/measures.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <set>
#include <stdexcept>

namespace spall
{
namespace
{
namespace fs = std::filesystem;

struct Figure
{
  const char *key, *label;
};

constexpr Figure figures[] = {{"elongation_1", "I / L"},
                              {"flatness_1", "S / I"},
                              {"sphericity_1", "sphericity (Wadell)"},
                              {"roundness_1", "roundness (R_g)"},
                              {"corner_fraction_1", "share of corners"},
                              {"saddle_fraction_1", "share of kappa_min < 0"},
                              {"largest_curvature_1", "largest kappa r_mean"}};
constexpr std::size_t n_figures = std::size(figures);

/// One row per particle.
using FigureRows = std::vector<std::array<double, n_figures>>;

std::array<double, n_figures> figures_of(const dem::Coefficients &shape)
{
  const dem::Calipers form = dem::calipers(shape);
  const dem::ShapeMeasures of =
      dem::measure_shape(shape, dem::standard_quadrature());
  return {form.width / form.length,
          form.thickness / form.width,
          of.sphericity,
          of.roundness,
          of.corner_fraction,
          of.saddle_fraction,
          of.max_curvature * of.mean_radius};
}

/// Mean and standard deviation of one figure over the particles.
struct Spread
{
  double mean = 0., deviation = 0.;
};

Spread spread(const FigureRows &rows, std::size_t column)
{
  Spread of;
  for (const auto &row : rows)
    of.mean += row[column] / double(rows.size());
  for (const auto &row : rows)
    of.deviation += std::pow(row[column] - of.mean, 2);
  if (rows.size() > 1)
    of.deviation = std::sqrt(of.deviation / double(rows.size() - 1));
  return of;
}

void print_comparison(const FigureRows &sample, const FigureRows &particles)
{
  std::printf("%-24s %8s %8s   %8s %8s\n", "", "sample", "+-", "particles",
              "+-");
  for (std::size_t i = 0; i < n_figures; ++i)
  {
    const Spread of_sample = spread(sample, i),
                 of_particles = spread(particles, i);
    std::printf("%-24s %8.3f %8.3f   %8.3f %8.3f\n", figures[i].label,
                of_sample.mean, of_sample.deviation, of_particles.mean,
                of_particles.deviation);
  }
}

void write_comparison(const std::string &path, const FigureRows &sample,
                      const FigureRows &particles)
{
  std::vector<ShapeFacts> groups = {{"sample", {}}, {"particles", {}}};
  for (const auto &[group, rows] :
       {std::pair(&groups[0], &sample), std::pair(&groups[1], &particles)})
    for (std::size_t i = 0; i < n_figures; ++i)
    {
      const Spread of = spread(*rows, i);
      const std::string key = figures[i].key;
      group->facts.push_back({key, figures[i].label, "-", of.mean});
      group->facts.push_back({key.substr(0, key.size() - 1) + "deviation_1", "",
                              "-", of.deviation});
    }
  write_facts(path, groups);
}

std::vector<ShapeFile> read_sample(const std::vector<std::string> &folders)
{
  std::vector<ShapeFile> sample;
  for (const std::string &folder : folders)
    for (ShapeFile &shape : read_shapes(folder))
      sample.push_back(std::move(shape));
  return sample;
}

void require_empty(const std::string &folder)
{
  if (fs::exists(folder) && !fs::is_directory(folder))
    throw InputError(folder + ": is not a folder");
  if (fs::exists(folder) && !fs::is_empty(folder))
    throw InputError(folder + ": is not empty; particles go to a new folder");
}

/// One text if all shapes agree, else all that there are.
std::string common_text(const std::vector<ShapeFile> &sample,
                        const std::string ShapeFile::*text)
{
  std::set<std::string> texts;
  for (const ShapeFile &shape : sample)
    texts.insert(shape.*text);
  std::string joined;
  for (const std::string &one : texts)
    joined += (joined.empty() ? "" : "; ") + one;
  return joined;
}

dem::ShapeGenerator make_generator(const std::vector<ShapeFile> &sample,
                                   int order)
{
  std::vector<dem::Coefficients> shapes;
  for (const ShapeFile &shape : sample)
    shapes.push_back(shape.coefficients);
  try
  {
    return dem::ShapeGenerator(shapes, order);
  }
  catch (const std::invalid_argument &error)
  {
    throw InputError(std::string("shape: ") + error.what());
  }
}

/// Writes the particles and returns their figures.
FigureRows write_particles(const ShapeWords &words,
                           const std::vector<ShapeFile> &sample,
                           const dem::ShapeGenerator &generator)
{
  dem::Random random(words.seed);
  ShapeFile particle;
  particle.order = words.order;
  particle.licence = common_text(sample, &ShapeFile::licence);
  FigureRows rows;
  for (int i = 1; i <= words.count; ++i)
  {
    char name[32];
    std::snprintf(name, sizeof name, "particle_%06d", i);
    particle.name = name;
    particle.source = "generated by Spall, seed " + std::to_string(words.seed) +
                      ", from " + common_text(sample, &ShapeFile::name);
    particle.coefficients = generator(random);
    write_shape((fs::path(words.out) / (particle.name + ".json")).string(),
                particle);
    rows.push_back(figures_of(particle.coefficients));
  }
  return rows;
}
} // namespace

int generate_shapes(const ShapeWords &words)
{
  if (words.out.empty() || words.count == 0 || !words.has_seed ||
      words.inputs.empty())
    fail_shape_usage();
  if (words.has_patch)
    throw InputError("shape: --patch is for corners");
  if (words.has_unit || words.has_fit)
    throw InputError("shape: --unit, --from, --max-overhang and --max-misfit "
                     "are for a mesh");
  require_empty(words.out);
  const std::vector<ShapeFile> sample = read_sample(words.inputs);
  const dem::ShapeGenerator generator = make_generator(sample, words.order);
  std::error_code error;
  if (!fs::create_directories(words.out, error) && error)
    throw InputError(words.out + ": cannot be made: " + error.message());
  const FigureRows particles = write_particles(words, sample, generator);
  FigureRows of_sample;
  for (const ShapeFile &shape : sample)
    of_sample.push_back(figures_of(shape.coefficients));
  if (!words.json.empty())
    write_comparison(words.json, of_sample, particles);
  std::printf("%d particles of order %d in %s, sample of %zu\n", words.count,
              words.order, words.out.c_str(), sample.size());
  print_comparison(of_sample, particles);
  return 0;
}
} // namespace spall
