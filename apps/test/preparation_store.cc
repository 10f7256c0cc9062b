#include "test/preparation_store.h"

#include "errors.h"
#include "run/binary_text.h"
#include "run/digest.h"
#include "run/digested.h"
#include "run/whole_file.h"
#include "test/checkpoint.h"

#include <dem/binary.h>

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

bool PreparationStore::take(const std::function<void(std::istream &)> &restore,
                            std::string &said) const
{
  if (!fs::exists(file))
    return false;
  try
  {
    std::ifstream state = open_state();
    restore(state);
    return true;
  }
  catch (const std::runtime_error &fault)
  {
    said = file.string() + ": " + fault.what() + ": is made again";
    return false;
  }
}

std::string
PreparationStore::store(const std::function<void(std::ostream &)> &save) const
{
  const auto write = [&](std::ostream &out)
  {
    dem::write_value(out, state_layout);
    write_text(out, text);
    save(out);
  };
  try
  {
    write_shared(file,
                 [&write](std::ostream &out) { write_digested(out, write); });
    return "preparation kept as " + file.string();
  }
  catch (const RunFailure &fault)
  {
    return fault.what() + std::string(": the preparation is not kept");
  }
}
} // namespace spall
