#include "icosphere.h"

#include <dem/assert.h>
#include <dem/io/vtk_output.h>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <cmath>
#include <iomanip>
#include <limits>
#include <map>
#include <numbers>
#include <sstream>
#include <stdexcept>

namespace dem
{
namespace
{
/// 1280 triangles.
constexpr int n_surface_divisions = 3;

/// One tuple per entry; `value(k)` gives a vector with n_components entries.
template <typename Value>
void add_vectors(vtkDataSetAttributes *data, const char *name, std::size_t n,
                 int n_components, const Value &value)
{
  vtkNew<vtkFloatArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(n_components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(n));
  for (std::size_t k = 0; k < n; ++k)
  {
    const auto entry = value(k);
    for (int i = 0; i < n_components; ++i)
      array->SetComponent(static_cast<vtkIdType>(k), i, entry[i]);
  }
  data->AddArray(array);
}

template <typename Array = vtkFloatArray, typename Value>
void add_scalars(vtkDataSetAttributes *data, const char *name, std::size_t n,
                 const Value &value)
{
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfTuples(static_cast<vtkIdType>(n));
  for (std::size_t k = 0; k < n; ++k)
    array->SetValue(static_cast<vtkIdType>(k), value(k));
  data->AddArray(array);
}

/// VTK makes the bytes only: its own writing prints a page about a full disk.
void write_grid(std::ostream &out, vtkUnstructuredGrid *grid)
{
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->WriteToOutputStringOn();
  writer->SetInputData(grid);
  writer->SetDataModeToAppended();
  writer->SetCompressorTypeToZLib();
  writer->SetIdTypeToInt32();
  if (writer->Write() != 1 || writer->GetErrorCode() != 0)
    throw std::runtime_error("VTK cannot make the contents of a frame");
  out << writer->GetOutputString();
}

void add_particle_fields(vtkPointData *data, const ParticleColumns &in)
{
  const std::size_t n = in.id.size();
  add_scalars<vtkTypeInt64Array>(data, "id", n,
                                 [&](std::size_t k) { return in.id[k]; });
  const auto scalar = [&](const char *name, std::span<const double> column)
  { add_scalars(data, name, n, [&](std::size_t k) { return column[k]; }); };
  scalar("radius_m", in.radius);
  scalar("mass_kg", in.mass);
  scalar("loss_1", in.loss);
  add_scalars(data, "volume_m3", n,
              [&](std::size_t k) { return in.body[k].volume; });
  add_scalars(data, "inscribed_radius_m", n,
              [&](std::size_t k) { return in.body[k].inscribed_radius; });
  add_vectors(data, "velocity_m_per_s", n, 3,
              [&](std::size_t k) { return in.velocity[k]; });
  add_vectors(data, "spin_rad_per_s", n, 3,
              [&](std::size_t k) { return in.spin[k]; });
  // The order that the glyphs of ParaView take for a quaternion.
  add_vectors(data, "orientation_wxyz", n, 4,
              [&](std::size_t k)
              {
                const Quaternion &q = in.orientation[k];
                return Eigen::Vector4d(q.w(), q.x(), q.y(), q.z());
              });
}

/// Radii of particles at the directions of one sphere. The harmonics are
/// evaluated once per order: a particle then costs one matrix product.
class SurfaceRadii
{
public:
  explicit SurfaceRadii(const std::vector<Vec3> &sphere) : directions(sphere) {}

  /// [m]; `equivalent_radius` is that of a particle without a series.
  Eigen::VectorXd of(const ParticleShape &body, double equivalent_radius)
  {
    const auto n = static_cast<Eigen::Index>(directions.size());
    if (!body.series)
      return Eigen::VectorXd::Constant(n, equivalent_radius);
    const Coefficients &series = *body.series;
    const Eigen::Map<const Eigen::VectorXd> a(
        series.data(), static_cast<Eigen::Index>(series.size()));
    return body.scale * (harmonics(order_of(series.size())).transpose() * a);
  }

private:
  /// Column k: the harmonics of direction k [-].
  const Eigen::MatrixXd &harmonics(int order)
  {
    Eigen::MatrixXd &table = tables[order];
    if (table.size() == 0)
    {
      const auto n = static_cast<std::size_t>(n_coefficients(order));
      table.resize(n_coefficients(order),
                   static_cast<Eigen::Index>(directions.size()));
      for (Eigen::Index k = 0; k < table.cols(); ++k)
        evaluate_harmonics(order, directions[static_cast<std::size_t>(k)],
                           {table.col(k).data(), n});
    }
    return table;
  }

  const std::vector<Vec3> &directions;
  std::map<int, Eigen::MatrixXd> tables; ///< by order
};

vtkNew<vtkPoints> make_points(std::size_t n)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToFloat();
  points->SetNumberOfPoints(static_cast<vtkIdType>(n));
  return points;
}

vtkNew<vtkPoints> surface_points(const ParticleColumns &in,
                                 const Icosphere &sphere)
{
  const std::size_t n_points = sphere.directions.size();
  vtkNew<vtkPoints> points = make_points(in.id.size() * n_points);
  SurfaceRadii radii(sphere.directions);
  vtkIdType next = 0;
  for (std::size_t k = 0; k < in.id.size(); ++k)
  {
    const Eigen::VectorXd r = radii.of(in.body[k], in.radius[k]);
    const Mat3 rotation = in.orientation[k].toRotationMatrix();
    for (std::size_t i = 0; i < n_points; ++i)
    {
      const Vec3 arm =
          r[static_cast<Eigen::Index>(i)] * (rotation * sphere.directions[i]);
      const Vec3 point = in.position[k] + arm;
      points->SetPoint(next++, point.data());
    }
  }
  return points;
}

vtkNew<vtkCellArray> surface_cells(std::size_t n_particles,
                                   const Icosphere &sphere)
{
  vtkNew<vtkCellArray> cells;
  const auto n_points = static_cast<vtkIdType>(sphere.directions.size());
  for (std::size_t k = 0; k < n_particles; ++k)
  {
    const vtkIdType first = static_cast<vtkIdType>(k) * n_points;
    for (const auto &[a, b, c] : sphere.triangles)
      cells->InsertNextCell({first + a, first + b, first + c});
  }
  return cells;
}

void add_contact_fields(vtkUnstructuredGrid *grid,
                        std::span<const ContactLine> in)
{
  vtkCellData *data = grid->GetCellData();
  const std::size_t n = in.size();
  add_scalars(data, "normal_force_N", n,
              [&](std::size_t k) { return in[k].normal_force; });
  add_scalars(data, "shear_force_N", n,
              [&](std::size_t k) { return in[k].shear_force; });
  add_scalars(data, "overlap_m", n,
              [&](std::size_t k) { return in[k].overlap; });
  add_scalars<vtkIntArray>(data, "kind", n,
                           [&](std::size_t k)
                           { return static_cast<int>(in[k].kind); });
  // Also on the points, where a tube filter reads its radius.
  add_scalars(grid->GetPointData(), "normal_force_N", 2 * n,
              [&](std::size_t k) { return in[k / 2].normal_force; });
}
using Grid = vtkSmartPointer<vtkUnstructuredGrid>;

Grid particle_grid(const ParticleColumns &particles)
{
  const std::size_t n = particles.id.size();
  DEM_ASSERT(particles.position.size() == n && particles.body.size() == n);
  vtkNew<vtkPoints> points = make_points(n);
  vtkNew<vtkCellArray> cells;
  for (std::size_t k = 0; k < n; ++k)
  {
    const auto point = static_cast<vtkIdType>(k);
    points->SetPoint(point, particles.position[k].data());
    cells->InsertNextCell({point});
  }
  Grid grid = Grid::New();
  grid->SetPoints(points);
  grid->SetCells(VTK_VERTEX, cells);
  add_particle_fields(grid->GetPointData(), particles);
  return grid;
}

Grid surface_grid(const ParticleColumns &particles)
{
  const std::size_t n = particles.id.size();
  DEM_ASSERT(particles.orientation.size() == n && particles.loss.size() == n);
  const Icosphere sphere = make_icosphere(n_surface_divisions);
  const std::size_t per_particle = sphere.triangles.size();
  Grid grid = Grid::New();
  grid->SetPoints(surface_points(particles, sphere));
  grid->SetCells(VTK_TRIANGLE, surface_cells(n, sphere));
  add_scalars<vtkTypeInt64Array>(grid->GetCellData(), "id", n * per_particle,
                                 [&](std::size_t k)
                                 { return particles.id[k / per_particle]; });
  add_scalars(grid->GetCellData(), "loss_1", n * per_particle,
              [&](std::size_t k) { return particles.loss[k / per_particle]; });
  return grid;
}

Grid contact_grid(std::span<const ContactLine> contacts)
{
  vtkNew<vtkPoints> points = make_points(2 * contacts.size());
  vtkNew<vtkCellArray> cells;
  for (std::size_t k = 0; k < contacts.size(); ++k)
  {
    const auto first = static_cast<vtkIdType>(2 * k);
    points->SetPoint(first, contacts[k].from.data());
    points->SetPoint(first + 1, contacts[k].to.data());
    cells->InsertNextCell({first, first + 1});
  }
  Grid grid = Grid::New();
  grid->SetPoints(points);
  if (!contacts.empty()) // readers mistrust a list of no cells
    grid->SetCells(VTK_LINE, cells);
  add_contact_fields(grid, contacts);
  return grid;
}

/// One of a part without content: its arrays are those of all pieces.
Grid empty_grid(FramePart part)
{
  if (part == FramePart::contacts)
    return contact_grid({});
  return part == FramePart::particles ? particle_grid({}) : surface_grid({});
}

/// As it stands in the XML files.
const char *type_of(vtkDataArray *array)
{
  switch (array->GetDataType())
  {
  case VTK_FLOAT:
    return "Float32";
  case VTK_INT:
    return "Int32";
  default:
    return "Int64";
  }
}

void declare_array(std::ostream &out, vtkDataArray *array)
{
  out << "<PDataArray type=\"" << type_of(array) << '"';
  if (array->GetName())
    out << " Name=\"" << array->GetName() << '"';
  out << " NumberOfComponents=\"" << array->GetNumberOfComponents() << "\"/>\n";
}

void declare_arrays(std::ostream &out, const std::string &element,
                    vtkDataSetAttributes *data)
{
  out << '<' << element << ">\n";
  for (int k = 0; k < data->GetNumberOfArrays(); ++k)
    declare_array(out, data->GetArray(k));
  out << "</" << element << ">\n";
}
} // namespace

void write_particles(std::ostream &out, const ParticleColumns &particles)
{
  write_grid(out, particle_grid(particles));
}

void write_surfaces(std::ostream &out, const ParticleColumns &particles)
{
  write_grid(out, surface_grid(particles));
}

void write_contacts(std::ostream &out, std::span<const ContactLine> contacts)
{
  write_grid(out, contact_grid(contacts));
}

void write_piece_index(std::ostream &out, FramePart part,
                       std::span<const std::string> pieces)
{
  const Grid grid = empty_grid(part);
  out << "<?xml version=\"1.0\"?>\n"
         "<VTKFile type=\"PUnstructuredGrid\" version=\"0.1\">\n"
         "<PUnstructuredGrid GhostLevel=\"0\">\n";
  declare_arrays(out, "PPointData", grid->GetPointData());
  declare_arrays(out, "PCellData", grid->GetCellData());
  out << "<PPoints>\n";
  declare_array(out, grid->GetPoints()->GetData());
  out << "</PPoints>\n";
  for (const std::string &piece : pieces)
    out << "<Piece Source=\"" << piece << "\"/>\n";
  out << "</PUnstructuredGrid>\n</VTKFile>\n";
}

void write_facets(std::ostream &out,
                  std::span<const FacetSurface *const> surfaces)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  std::vector<Vec3> load, velocity;
  std::vector<int> number;
  for (std::size_t k = 0; k < surfaces.size(); ++k)
  {
    const FacetSurface &surface = *surfaces[k];
    const auto first = static_cast<vtkIdType>(load.size());
    for (const Vec3 &point : surface.position)
      points->InsertNextPoint(point.data());
    for (const auto &t : surface.triangles)
      cells->InsertNextCell({first + t[0], first + t[1], first + t[2]});
    number.insert(number.end(), surface.triangles.size(), static_cast<int>(k));
    load.insert(load.end(), surface.load.begin(), surface.load.end());
    velocity.insert(velocity.end(), surface.velocity.begin(),
                    surface.velocity.end());
  }
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  grid->SetCells(VTK_TRIANGLE, cells);
  add_scalars<vtkIntArray>(grid->GetCellData(), "wall", number.size(),
                           [&](std::size_t k) { return number[k]; });
  add_vectors(grid->GetPointData(), "load_N", load.size(), 3,
              [&](std::size_t k) { return load[k]; });
  add_vectors(grid->GetPointData(), "velocity_m_per_s", velocity.size(), 3,
              [&](std::size_t k) { return velocity[k]; });
  write_grid(out, grid);
}

void write_drum(std::ostream &stream, const Drum &drum)
{
  constexpr int n_strips = 72;
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  const Vec3 out = lifter_direction(drum), side = drum.axis.cross(out);
  // Points of a line along the axis, then quads from each line to the next.
  const auto add_line = [&](double u, double v)
  {
    for (const double end : {-0.5, 0.5})
    {
      const Vec3 point =
          drum.centre + u * out + v * side + end * drum.length * drum.axis;
      points->InsertNextPoint(point.data());
    }
  };
  const auto join_lines = [&](vtkIdType first, vtkIdType last)
  {
    for (vtkIdType k = 2 * first; k < 2 * last; k += 2)
      cells->InsertNextCell({k, k + 1, k + 3, k + 2});
  };
  for (int k = 0; k <= n_strips; ++k)
  {
    const double angle = 2. * std::numbers::pi * k / n_strips;
    add_line(drum.radius * std::cos(angle), drum.radius * std::sin(angle));
  }
  join_lines(0, n_strips);
  if (drum.lifter_height > 0.)
  {
    const double tip = drum.radius - drum.lifter_height,
                 half = 0.5 * drum.lifter_thickness;
    add_line(drum.radius, -half);
    add_line(tip, -half);
    add_line(tip, half);
    add_line(drum.radius, half);
    join_lines(n_strips + 1, n_strips + 4);
  }
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  grid->SetCells(VTK_QUAD, cells);
  write_grid(stream, grid);
}

std::string collection_text(std::span<const FrameEntry> entries)
{
  std::ostringstream out;
  out << std::setprecision(std::numeric_limits<double>::max_digits10)
      << "<?xml version=\"1.0\"?>\n"
         "<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
  for (const FrameEntry &entry : entries)
    out << "<DataSet timestep=\"" << entry.time << "\" part=\"" << entry.part
        << "\" file=\"" << entry.file << "\"/>\n";
  out << "</Collection>\n</VTKFile>\n";
  return out.str();
}
} // namespace dem
