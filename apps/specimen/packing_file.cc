#include "specimen/packing_file.h"

#include "case/parameter.h"
#include "errors.h"
#include "run/whole_file.h"
#include "specimen/csv_table.h"
#include "specimen/json_table.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace spall
{
namespace
{
constexpr const char *plain_header = "x,y,z,radius";
constexpr const char *turned_header = "x,y,z,radius,qw,qx,qy,qz";
const std::string any_header =
    "x,y,z,radius (or diameter), and any of qw,qx,qy,qz, vx,vy,vz, wx,wy,wz, "
    "shape, material";

/// Groups of columns: all of a group or none.
const std::vector<std::string> position_names = {"x", "y", "z"},
                               orientation_names = {"qw", "qx", "qy", "qz"},
                               velocity_names = {"vx", "vy", "vz"},
                               spin_names = {"wx", "wy", "wz"};

/// The columns of a group in the table; empty if it has none of them.
std::vector<std::size_t> columns_of(const CsvTable &table,
                                    const std::vector<std::string> &group)
{
  std::vector<std::size_t> columns;
  for (const std::string &name : group)
    if (const int column = table.column(name); column >= 0)
      columns.push_back(static_cast<std::size_t>(column));
  if (!columns.empty() && columns.size() != group.size())
    table.header.refuse("the header must be " + any_header);
  return columns;
}

/// Which column is what.
struct PackingColumns
{
  std::vector<std::size_t> position, orientation, velocity, spin;
  int size = -1, shape = -1, material = -1;
  bool is_diameter = false;

  explicit PackingColumns(const CsvTable &table)
      : position(columns_of(table, position_names)),
        orientation(columns_of(table, orientation_names)),
        velocity(columns_of(table, velocity_names)),
        spin(columns_of(table, spin_names)), size(table.column("radius")),
        shape(table.column("shape")), material(table.column("material"))
  {
    const int diameter = table.column("diameter");
    is_diameter = size < 0;
    const bool has_both = size >= 0 && diameter >= 0;
    if (is_diameter)
      size = diameter;
    const std::size_t known = position.size() + orientation.size() +
                              velocity.size() + spin.size() + 1 + (shape >= 0) +
                              (material >= 0);
    if (position.empty() || size < 0 || has_both ||
        known != table.header.cells.size())
      table.header.refuse("the header must be " + any_header);
  }
};

double number(const CsvRow &row, std::size_t column)
{
  try
  {
    return to_number(row.cells[column]);
  }
  catch (const std::invalid_argument &)
  {
    row.refuse("\"" + row.cells[column] + "\" must be a number");
  }
}

dem::Vec3 vector(const CsvRow &row, const std::vector<std::size_t> &columns)
{
  return {number(row, columns[0]), number(row, columns[1]),
          number(row, columns[2])};
}

void add_particle(Packing &packing, const CsvRow &row,
                  const PackingColumns &columns)
{
  const double size = number(row, static_cast<std::size_t>(columns.size));
  if (size <= 0.)
    row.refuse(columns.is_diameter ? "the diameter must be above 0"
                                   : "the radius must be above 0");
  packing.position.push_back(vector(row, columns.position));
  packing.radius.push_back(columns.is_diameter ? 0.5 * size : size);
  if (const auto &q = columns.orientation; !q.empty())
  {
    const dem::Quaternion turn(number(row, q[0]), number(row, q[1]),
                               number(row, q[2]), number(row, q[3]));
    if (!(std::abs(turn.norm() - 1.) < 1e-6))
      row.refuse("the quaternion must have length 1");
    // What has all its digits stays as it is, bit for bit.
    packing.orientation.push_back(
        std::abs(turn.norm() - 1.) < 1e-14 ? turn : turn.normalized());
  }
  if (!columns.velocity.empty())
    packing.velocity.push_back(vector(row, columns.velocity));
  if (!columns.spin.empty())
    packing.spin.push_back(vector(row, columns.spin));
  if (columns.shape >= 0)
    packing.shape.push_back(row.cells[static_cast<std::size_t>(columns.shape)]);
  if (columns.material >= 0)
    packing.material.push_back(
        row.cells[static_cast<std::size_t>(columns.material)]);
  packing.location.push_back(row.location);
}

/// Takes a row `# box LX LY LZ`; other comments are left alone.
void take_comment(Packing &packing, const CsvRow &row)
{
  std::istringstream words(row.text.substr(1));
  std::string name;
  if (!(words >> name) || name != "box")
    return;
  std::vector<double> sides;
  try
  {
    for (std::string word; words >> word;)
      sides.push_back(to_number(word));
  }
  catch (const std::invalid_argument &)
  {
  }
  if (sides.size() != 3 || !(std::min({sides[0], sides[1], sides[2]}) > 0.))
    row.refuse("must be # box LX LY LZ, three numbers above 0");
  packing.box = {sides[0], sides[1], sides[2]};
}
} // namespace

Packing read_placed_particles(const std::string &path)
{
  const CsvTable table = path.ends_with(".json") ? read_json_table(path)
                                                 : read_csv(path, any_header);
  const PackingColumns columns(table);
  Packing packing;
  for (const CsvRow &row : table.comments)
    take_comment(packing, row);
  for (const CsvRow &row : table.rows)
    add_particle(packing, row, columns);
  if (packing.size() == 0)
    throw InputError(path + ": has no particles, must be " + plain_header +
                     " and one row per particle");
  return packing;
}

namespace
{
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
  Packing packing = read_placed_particles(path);
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
