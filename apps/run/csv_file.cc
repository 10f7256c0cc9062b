#include "run/csv_file.h"

#include "case/parameter.h"
#include "errors.h"
#include "run/whole_file.h"

#include <system_error>

namespace spall
{
namespace fs = std::filesystem;

std::string csv_row(const std::vector<double> &values)
{
  std::string line;
  for (const double value : values)
    line += (line.empty() ? "" : ",") + number_text(value);
  return line + "\n";
}

void CsvFile::open(const fs::path &path, const std::string &header)
{
  file.open_empty(path);
  file.add(header + "\n");
}

void CsvFile::resume(const fs::path &path, std::uint64_t size)
{
  file.flush(); // a file that is open goes back to an earlier state
  std::error_code status;
  const std::uintmax_t found = fs::file_size(path, status);
  if (status || found < size)
    throw InputError("--resume: " + path.string() + ": " +
                     (status ? "is missing"
                             : "is shorter than when the checkpoint was "
                               "written"));
  fs::resize_file(path, size, status);
  if (status)
    throw RunFailure(write_failure(path, status.value()));
  file.open_at_end(path);
}

void CsvFile::write_row(const std::vector<double> &values)
{
  file.add(csv_row(values));
}

std::uint64_t CsvFile::flushed_size()
{
  file.synchronise();
  return file.size();
}
} // namespace spall
