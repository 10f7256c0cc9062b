#include "run/file_of_all_ranks.h"

#include "run/first_rank.h"

#include <optional>
#include <streambuf>

namespace spall
{
namespace
{
/// Takes all and keeps nothing.
class Nowhere : public std::streambuf
{
protected:
  int_type overflow(int_type c) override { return traits_type::not_eof(c); }
  std::streamsize xsputn(const char *, std::streamsize n) override { return n; }
};
} // namespace

void write_of_all_ranks(const dem::Ranks &ranks,
                        const std::filesystem::path &path, Writers writers,
                        const std::function<void(std::ostream &)> &write)
{
  std::optional<WholeFile> file;
  on_first_rank(ranks,
                [&]
                {
                  file.emplace(path, Durability::on_disk, writers);
                  file->require_sound();
                });
  Nowhere nowhere;
  std::ostream none(&nowhere);
  write(file ? file->out() : none);
  on_first_rank(ranks,
                [&]
                {
                  file->finish();
                  file->require_sound();
                });
}
} // namespace spall
