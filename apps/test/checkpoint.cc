#include "test/checkpoint.h"

#include "case/digits.h"
#include "case/fields.h"
#include "case/parameter.h"
#include "errors.h"
#include "run/binary_text.h"
#include "run/digest.h"
#include "run/digested.h"
#include "run/file_of_all_ranks.h"
#include "run/first_rank.h"

#include <dem/binary.h>
#include <dem/parallel/shared_input.h>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace spall
{
namespace
{
constexpr std::uint64_t magic = state_layout;

using dem::read_value;
using dem::write_value;

/// Of the case, a line each, what must not change between stop and restart: of
/// files and folders the contents, whatever their paths.
std::string identity_of(Case parameters)
{
  const TestKind &kind = *find_kind(parameters.kind);
  std::map<std::string, bool> has_section;
  for (const ListedSection &section : sections(parameters))
    has_section[section.name] = section.is_of(kind.name);
  std::string text;
  for (const Parameter &p : parameters_of(parameters))
    if (has_section[p.section] && p.is_of(kind.name) && !p.may_change &&
        !p.is_path &&
        std::ranges::find(kind.may_change, p.name()) == kind.may_change.end())
      text += p.name() + " = " + value_text(p) + "\n";
  for (const Parameter &p : parameters_of(parameters))
    if (p.may_change)
      parameters.contents.erase(p.name());
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
  std::uint64_t n = 0;
  read_value(in, n);
  for (std::uint64_t k = 0; k < n; ++k)
  {
    const std::string table = read_text(in);
    read_value(in, done.table_sizes[table]);
  }
  read_value(in, done.n_frames);
  read_value(in, n);
  for (std::uint64_t k = 0; k < n; ++k)
  {
    dem::FrameEntry &entry = done.frames.emplace_back();
    read_value(in, entry.time);
    read_value(in, entry.part);
    entry.file = read_text(in);
  }
  read_value(in, n);
  for (std::uint64_t k = 0; k < n; ++k)
  {
    const std::string phase = read_text(in);
    read_value(in, done.spent[phase]);
  }
}

/// Up to what follows the mark; throws std::runtime_error.
std::ifstream open_checkpoint(const std::filesystem::path &path)
{
  std::ifstream in(path, std::ios::binary);
  std::uint64_t mark = 0;
  read_value(in, mark);
  if (mark != magic)
    throw std::runtime_error("not a checkpoint of this version");
  if (!is_as_digested(path))
    throw std::runtime_error("checkpoint is damaged");
  return in;
}

void write_progress(std::ostream &out, const Progressed &done)
{
  write_value(out, static_cast<std::uint64_t>(done.table_sizes.size()));
  for (const auto &[table, size] : done.table_sizes)
  {
    write_text(out, table);
    write_value(out, size);
  }
  write_value(out, done.n_frames);
  write_value(out, static_cast<std::uint64_t>(done.frames.size()));
  for (const dem::FrameEntry &entry : done.frames)
  {
    write_value(out, entry.time);
    write_value(out, entry.part);
    write_text(out, entry.file);
  }
  write_value(out, static_cast<std::uint64_t>(done.spent.size()));
  for (const auto &[phase, seconds] : done.spent)
  {
    write_text(out, phase);
    write_value(out, seconds);
  }
}
} // namespace

void write_checkpoint(const dem::Ranks &ranks,
                      const std::filesystem::path &path, const Case &parameters,
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
  write_of_all_ranks(ranks, path, Writers::one,
                     [&write](std::ostream &file)
                     { write_digested(file, write); });
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
    throw std::runtime_error("has reached " + in_four_digits(done) + " where " +
                             key + " is " + number_text(asked) +
                             ": must not be less");
}

void read_checkpoint(const dem::Ranks &ranks, const std::filesystem::path &path,
                     const Case &parameters,
                     const std::function<void(std::istream &)> &restore,
                     Progressed &done)
{
  std::ifstream file;
  const auto refuse = [&path](const std::runtime_error &error)
  { throw InputError("--resume: " + path.string() + ": " + error.what()); };
  on_first_rank(ranks,
                [&]
                {
                  require_checkpoint(path);
                  try
                  {
                    file = open_checkpoint(path);
                  }
                  catch (const std::runtime_error &error)
                  {
                    refuse(error);
                  }
                });
  dem::SharedInput shared(ranks, file.is_open() ? &file : nullptr);
  std::istream &in = shared.stream();
  try
  {
    if (const std::string then = read_text(in), now = identity_of(parameters);
        then != now)
      throw std::runtime_error(
          "is of another case: " + first_difference(then, now) +
          ": restore the value, or choose another --out");
    read_progress(in, done);
    restore(in);
  }
  catch (const std::runtime_error &error)
  {
    refuse(error);
  }
}
} // namespace spall
