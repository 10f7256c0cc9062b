#include "test/preparation_store.h"

#include "errors.h"
#include "run/binary_text.h"
#include "run/digest.h"
#include "run/digested.h"
#include "run/file_of_all_ranks.h"
#include "test/checkpoint.h"

#include <dem/binary.h>
#include <dem/parallel/first_rank.h>
#include <dem/parallel/shared_input.h>

#include <utility>

namespace spall
{
namespace
{
namespace fs = std::filesystem;

std::uint64_t digest_of(const std::string &bytes)
{
  Digest digest;
  digest.add(bytes);
  return digest.value();
}
} // namespace

PreparationStore::PreparationStore(fs::path folder, std::string its_text)
    : text(std::move(its_text)),
      file(folder / (hex_text(digest_of(text)) + ".bin"))
{
  std::error_code status;
  fs::create_directories(folder, status);
  if (!fs::is_directory(folder))
    throw InputError("--preparations " + folder.string() +
                     ": cannot be made: must be a folder that may be written");
}

std::ifstream PreparationStore::open_state() const
{
  std::ifstream in(file, std::ios::binary);
  std::uint64_t mark = 0;
  dem::read_value(in, mark);
  if (mark != state_layout)
    throw std::runtime_error("is not a preparation of this version");
  if (!is_as_digested(file))
    throw std::runtime_error("is damaged");
  if (read_text(in) != text)
    throw std::runtime_error("is of another preparation");
  return in;
}

std::string PreparationStore::unsound(const std::runtime_error &fault) const
{
  return file.string() + ": " + fault.what() + ": is made again";
}

bool PreparationStore::take(const dem::Ranks &ranks,
                            const std::function<void(std::istream &)> &restore,
                            std::string &said) const
{
  std::ifstream state;
  if (ranks.rank() == 0 && fs::exists(file))
    try
    {
      state = open_state();
    }
    catch (const std::runtime_error &fault)
    {
      said = unsound(fault);
    }
  said = dem::of_first_rank(ranks, said);
  if (!dem::of_first_rank(ranks, state.is_open()))
    return false;
  dem::SharedInput shared(ranks, state.is_open() ? &state : nullptr);
  try
  {
    restore(shared.stream());
    return true;
  }
  catch (const std::runtime_error &fault)
  {
    said = unsound(fault);
    return false;
  }
}

std::string
PreparationStore::store(const dem::Ranks &ranks,
                        const std::function<void(std::ostream &)> &save) const
{
  const auto write = [&](std::ostream &out)
  {
    dem::write_value(out, state_layout);
    write_text(out, text);
    save(out);
  };
  try
  {
    write_of_all_ranks(ranks, file, Writers::several,
                       [&write](std::ostream &out)
                       { write_digested(out, write); });
    return "preparation kept as " + file.string();
  }
  catch (const RunFailure &fault)
  {
    return fault.what() + std::string(": the preparation is not kept");
  }
}
} // namespace spall
