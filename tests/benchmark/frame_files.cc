// Size and writing time of the files of a frame: the table of
// docs/user/frame_tables.md.
//
//   frame_files PACKING.csv SHAPES N_REPEATS
//
// The particles of a packing, with the shapes of a folder, lie in their box for
// a moment. Then each file of a frame is written N_REPEATS times into the
// folder for temporary files; times are medians. CSV files have the columns of
// the HDF5 tables with as many digits as read back as the same number.
#include "bench/scene.h"
#include "run/frame_tables.h"
#include "run/frames.h"
#include "run/scratch_folder.h"
#include "run/whole_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

namespace
{
namespace fs = std::filesystem;

double seconds()
{
  return std::chrono::duration<double>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

void add_text(const std::string &value, std::string &text)
{
  text += value;
}

template <class Number>
void add_text(Number value, std::string &text)
{
  std::array<char, 40> digits;
  text.append(
      digits.data(),
      std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
}

/// A row for each row of the table, the components of a column side by side.
void write_csv(std::ostream &out, const dem::TableGroup &table)
{
  std::string text;
  std::size_t n_rows = 0;
  for (const dem::TableColumn &column : table.columns)
  {
    n_rows = std::visit([](const auto &values) { return values.size(); },
                        column.values) /
             column.n_components;
    for (std::size_t d = 0; d < column.n_components; ++d)
      text += (text.empty() ? "" : ",") + column.name;
  }
  text += '\n';
  for (std::size_t row = 0; row < n_rows; ++row)
  {
    const std::size_t start = text.size();
    for (const dem::TableColumn &column : table.columns)
      for (std::size_t d = 0; d < column.n_components; ++d)
      {
        if (text.size() > start)
          text += ',';
        std::visit([&](const auto &values)
                   { add_text(values[row * column.n_components + d], text); },
                   column.values);
      }
    text += '\n';
  }
  out << text;
}

/// Bytes of the files in a folder with one of these beginnings.
std::uintmax_t size_of(const fs::path &folder,
                       const std::vector<std::string> &beginnings)
{
  std::uintmax_t sum = 0;
  for (const fs::directory_entry &entry : fs::directory_iterator(folder))
    for (const std::string &beginning : beginnings)
      if (entry.path().filename().string().starts_with(beginning))
        sum += entry.file_size();
  return sum;
}

/// Of one call [s].
template <class Call>
double median_time(int n_repeats, const Call &call)
{
  std::vector<double> spent;
  for (int k = 0; k < n_repeats; ++k)
  {
    const double begun = seconds();
    call();
    spent.push_back(seconds() - begun);
  }
  std::ranges::nth_element(spent, spent.begin() + n_repeats / 2);
  return spent[static_cast<std::size_t>(n_repeats / 2)];
}

void print_row(const char *name, std::uintmax_t bytes, double time)
{
  std::printf("| %s | %.2f | %.0f |\n", name, 1e-6 * double(bytes), 1e3 * time);
}

void measure(const std::string &packing, const std::string &shapes,
             int n_repeats)
{
  const spall::BenchParticles particles =
      spall::make_bench_particles(spall::read_packing(packing), shapes);
  const auto engine =
      spall::make_bench_engine(particles, spall::BenchScene::rest, false);
  spall::settle(*engine, spall::BenchScene::rest,
                spall::settling_steps(spall::BenchScene::rest));
  const spall::ScratchFolder scratch;
  const fs::path folder = scratch.path(), frames = folder / "frames";
  fs::create_directory(frames);

  const auto paraview = [&](bool has_surfaces)
  {
    return median_time(n_repeats,
                       [&]
                       {
                         std::vector<dem::FrameEntry> entries(1);
                         spall::write_frame(folder, *engine,
                                            {nullptr, has_surfaces}, 0,
                                            entries);
                       });
  };
  const dem::FrameDescription frame;
  const double tables = median_time(
      n_repeats, [&] { spall::write_frame_tables(folder, *engine, frame); });
  const double csv = median_time(
      n_repeats,
      [&]
      {
        for (const dem::TableGroup &table :
             dem::frame_tables(*engine, frame).groups)
          spall::write_whole(frames / (table.name + ".csv"),
                             [&](std::ostream &out) { write_csv(out, table); });
      });
  std::size_t n_contacts = 0;
  for (const dem::TableGroup &table : dem::frame_tables(*engine, frame).groups)
    if (table.name == "contacts")
      n_contacts =
          std::get<std::vector<std::int64_t>>(table.columns[0].values).size();
  std::printf("%zu particles, %zu contacts\n\n| files of a frame | size (MB) | "
              "time (ms) |\n|---|---|---|\n",
              engine->particles().size(), n_contacts);
  const double points = paraview(false), surfaces = paraview(true);
  print_row("ParaView, particles and contacts, single precision",
            size_of(frames, {"particles_", "contacts_"}), points);
  print_row("ParaView, surfaces of the particles as well",
            size_of(frames, {"particles_", "contacts_", "surfaces_"}),
            surfaces);
  print_row("HDF5 tables", size_of(frames, {"tables_"}), tables);
  print_row("the same tables as CSV files",
            size_of(frames, {"particles.csv", "contacts.csv", "boundaries.csv",
                             "shapes.csv"}),
            csv);
}
} // namespace

int main(int argc, char **argv)
{
  if (argc != 4 || std::atoi(argv[3]) < 1)
  {
    std::fprintf(stderr, "usage: frame_files PACKING.csv SHAPES N_REPEATS\n");
    return 1;
  }
  try
  {
    measure(argv[1], argv[2], std::atoi(argv[3]));
  }
  catch (const std::exception &error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
