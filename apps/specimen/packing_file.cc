#include "specimen/packing_file.h"

#include "case/parameter.h"
#include "errors.h"
#include "run/whole_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <zlib.h>

namespace spall
{
namespace
{
constexpr const char *plain_header = "x,y,z,radius";
constexpr const char *turned_header = "x,y,z,radius,qw,qx,qy,qz";

/// The whole file, unpacked if it is compressed.
std::string file_text(const std::string &path)
{
  if (!std::filesystem::exists(path))
    throw InputError(path + ": no such file");
  if (std::filesystem::is_directory(path))
    throw InputError(path + ": is a folder, must be a packing (CSV)");
  const gzFile file = gzopen(path.c_str(), "rb");
  if (file == nullptr)
    throw InputError(path + ": cannot be read");
  std::string text;
  std::vector<char> block(1 << 16);
  int n = 0;
  while ((n = gzread(file, block.data(),
                     static_cast<unsigned int>(block.size()))) > 0)
    text.append(block.data(), static_cast<std::size_t>(n));
  // A file that ends in the middle is reported by the last call.
  if (gzclose_r(file) != Z_OK || n < 0)
    throw InputError(path + ": cannot be unpacked, is it cut off?");
  return text;
}

/// The numbers of a row; throws std::invalid_argument.
std::vector<double> numbers(const std::string &row, char separator)
{
  std::vector<double> values;
  std::istringstream fields(row);
  for (std::string field; std::getline(fields, field, separator);)
    if (separator != ' ' || !field.empty())
      values.push_back(to_number(field));
  return values;
}

/// The text without spaces before and after it.
std::string trimmed(const std::string &text)
{
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos)
    return "";
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// Takes a row `# box LX LY LZ`; other comments are left alone.
void take_comment(Packing &packing, const std::string &row,
                  const std::string &location)
{
  const std::string text = trimmed(row.substr(1));
  if (!text.starts_with("box"))
    return;
  std::vector<double> sides;
  try
  {
    sides = numbers(text.substr(3), ' ');
  }
  catch (const std::invalid_argument &)
  {
  }
  if (sides.size() != 3 || !(std::min({sides[0], sides[1], sides[2]}) > 0.))
    throw InputError(location + ": \"" + row +
                     "\": must be # box LX LY LZ, three numbers above 0");
  packing.box = {sides[0], sides[1], sides[2]};
}

void add_particle(Packing &packing, const std::string &row,
                  const std::string &location, bool is_turned)
{
  std::vector<double> v;
  try
  {
    v = numbers(row, ',');
  }
  catch (const std::invalid_argument &)
  {
  }
  if (v.size() != (is_turned ? 8 : 4))
    throw InputError(location + ": \"" + row + "\": a row is " +
                     (is_turned ? "eight" : "four") + " numbers, " +
                     (is_turned ? turned_header : plain_header));
  if (v[3] <= 0.)
    throw InputError(location + ": \"" + row +
                     "\": the radius must be above 0");
  packing.position.emplace_back(v[0], v[1], v[2]);
  packing.radius.push_back(v[3]);
  if (!is_turned)
    return;
  const dem::Quaternion q(v[4], v[5], v[6], v[7]);
  if (!(std::abs(q.norm() - 1.) < 1e-9))
    throw InputError(location + ": \"" + row +
                     "\": the quaternion must have length 1");
  packing.orientation.push_back(q);
}

/// Every centre is inside the box.
void require_inside(const Packing &packing, const std::string &path)
{
  for (std::size_t k = 0; k < packing.size(); ++k)
    for (int d = 0; d < 3; ++d)
      if (const double x = packing.position[k][d]; x < 0. || x > packing.box[d])
        throw InputError(path + ": particle " + std::to_string(k + 1) +
                         " has " + "xyz"[d] + " = " + number_text(x) +
                         " m: must be in the box, 0 to " +
                         number_text(packing.box[d]) + " m");
}
} // namespace

double side_of(const Packing &packing)
{
  dem::Vec3 above = dem::Vec3::Constant(-1e300), below = above;
  for (std::size_t k = 0; k < packing.size(); ++k)
  {
    const dem::Vec3 r = dem::Vec3::Constant(packing.radius[k]);
    above = above.cwiseMax(packing.position[k] + r);
    below = below.cwiseMax(r - packing.position[k]);
  }
  return 1e-4 * std::round(1e4 * (above - below).mean());
}

Packing read_packing(const std::string &path)
{
  std::istringstream in(file_text(path));
  Packing packing;
  bool has_header = false, is_turned = false;
  int n_lines = 0;
  for (std::string line; std::getline(in, line);)
  {
    const std::string location = path + ":" + std::to_string(++n_lines);
    const std::string row = trimmed(line);
    if (row.empty())
      continue;
    if (row.starts_with('#'))
      take_comment(packing, row, location);
    else if (has_header)
      add_particle(packing, row, location, is_turned);
    else if (row == plain_header || row == turned_header)
    {
      has_header = true;
      is_turned = row == turned_header;
    }
    else
      throw InputError(location + ": \"" + row.substr(0, 80) +
                       "\": the header must be " + plain_header + " or " +
                       turned_header);
  }
  if (packing.size() == 0)
    throw InputError(path + ": has no particles, must be " + plain_header +
                     " and one row per particle");
  if (packing.box.isZero())
    packing.box = dem::Vec3::Constant(side_of(packing));
  require_inside(packing, path);
  return packing;
}

void write_packing(const std::string &path, const Packing &packing)
{
  std::ostringstream out;
  out << "# box";
  for (int d = 0; d < 3; ++d)
    out << ' ' << number_text(packing.box[d]);
  const bool is_turned = !packing.orientation.empty();
  out << '\n' << (is_turned ? turned_header : plain_header) << '\n';
  for (std::size_t k = 0; k < packing.size(); ++k)
  {
    const dem::Vec3 &x = packing.position[k];
    out << number_text(x.x()) << ',' << number_text(x.y()) << ','
        << number_text(x.z()) << ',' << number_text(packing.radius[k]);
    if (is_turned)
    {
      const dem::Quaternion &q = packing.orientation[k];
      out << ',' << number_text(q.w()) << ',' << number_text(q.x()) << ','
          << number_text(q.y()) << ',' << number_text(q.z());
    }
    out << '\n';
  }
  write_asked(path, out.str());
}
} // namespace spall
