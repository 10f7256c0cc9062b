#include "test_folder.h"

#include <dem/io/vtk_output.h>

#include <gtest/gtest.h>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

namespace
{
using dem::Vec3;

/// Files are single precision.
constexpr double rounding = 1e-6;

std::string scratch(const std::string &name)
{
  return (support::test_folder() / name).string();
}

template <class Writer, class Content>
void write(const std::string &path, Writer *writer, const Content &content)
{
  std::ofstream file(path, std::ios::binary);
  writer(file, content);
}

vtkNew<vtkXMLUnstructuredGridReader> read(const std::string &path)
{
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader;
}

/// A sphere and a particle r = a_00 Y_00 + a_1,1 Y_1,1, turned by 90 degrees
/// about z: its longest radius points to +y.
class TwoParticles : public testing::Test
{
protected:
  TwoParticles()
  {
    bodies[0].scale = 0.01;
    bodies[1].series =
        std::make_shared<dem::Coefficients>(std::initializer_list<double>{
            2. * std::sqrt(std::numbers::pi), 0., 0., tilt});
    bodies[1].scale = 0.02;
    bodies[1].volume = 3e-5;
    bodies[1].inscribed_radius = 0.015;
  }

  dem::ParticleColumns columns() const
  {
    return {.id = ids,
            .position = positions,
            .velocity = velocities,
            .spin = spins,
            .orientation = orientations,
            .body = bodies,
            .radius = radii,
            .mass = masses,
            .loss = losses};
  }

  static constexpr double tilt = 0.2; ///< a_1,1 [-]
  std::vector<std::int64_t> ids{7, 11};
  std::vector<Vec3> positions{{0., 0., 0.}, {0.1, 0.2, 0.3}},
      velocities{{1., 2., 3.}, {4., 5., 6.}},
      spins{{0.1, 0., 0.}, {0., 0., 0.7}};
  std::vector<dem::Quaternion> orientations{
      dem::Quaternion::Identity(),
      dem::Quaternion(Eigen::AngleAxisd(std::numbers::pi / 2., Vec3::UnitZ()))};
  std::vector<dem::ParticleShape> bodies{2};
  std::vector<double> radii{0.01, 0.02}, masses{0.011, 0.09}, losses{0., 0.003};
};

TEST_F(TwoParticles, ParticlesComeBackWithEveryField)
{
  const std::string path = scratch("particles.vtu");
  write(path, dem::write_particles, columns());
  const auto reader = read(path);
  vtkUnstructuredGrid *grid = reader->GetOutput();
  ASSERT_EQ(grid->GetNumberOfPoints(), 2);
  ASSERT_EQ(grid->GetNumberOfCells(), 2);
  EXPECT_NEAR(grid->GetPoint(1)[2], 0.3, rounding);
  vtkPointData *data = grid->GetPointData();
  const auto value = [&](const char *name, int component = 0)
  {
    vtkDataArray *array = data->GetArray(name);
    return array ? array->GetComponent(1, component) : std::nan(name);
  };
  EXPECT_EQ(value("id"), 11.);
  EXPECT_NEAR(value("radius_m"), 0.02, rounding);
  EXPECT_NEAR(value("mass_kg"), 0.09, rounding);
  EXPECT_NEAR(value("loss_1"), 0.003, rounding);
  EXPECT_NEAR(value("volume_m3"), 3e-5, rounding * 3e-5);
  EXPECT_NEAR(value("inscribed_radius_m"), 0.015, rounding);
  EXPECT_NEAR(value("velocity_m_per_s", 1), 5., rounding);
  EXPECT_NEAR(value("spin_rad_per_s", 2), 0.7, rounding);
  EXPECT_NEAR(value("orientation_wxyz", 0), std::sqrt(0.5), rounding);
  EXPECT_NEAR(value("orientation_wxyz", 3), std::sqrt(0.5), rounding);
}

TEST_F(TwoParticles, SurfacesAreTheSeriesRotatedAndPlaced)
{
  const std::string path = scratch("surfaces.vtu");
  write(path, dem::write_surfaces, columns());
  const auto reader = read(path);
  vtkUnstructuredGrid *grid = reader->GetOutput();
  ASSERT_EQ(grid->GetNumberOfCells(), 2 * 1280);
  const vtkIdType n = grid->GetNumberOfPoints() / 2;
  for (vtkIdType k = 0; k < n; ++k)
  {
    EXPECT_NEAR(Vec3(grid->GetPoint(k)).norm(), 0.01, rounding);
    const Vec3 arm = Vec3(grid->GetPoint(n + k)) - positions[1];
    // Y_1,1 = sqrt(3 / 4 pi) x of the body, which is y of the world.
    const double y_11 =
        std::sqrt(3. / (4. * std::numbers::pi)) * arm.normalized().y();
    EXPECT_NEAR(arm.norm(), 0.02 * (1. + tilt * y_11), rounding);
  }
}

TEST_F(TwoParticles, SurfacesCarryIdAndLossPerTriangleAndFaceOutward)
{
  const std::string path = scratch("surfaces_data.vtu");
  write(path, dem::write_surfaces, columns());
  const auto reader = read(path);
  vtkUnstructuredGrid *grid = reader->GetOutput();
  vtkDataArray *ids_read = grid->GetCellData()->GetArray("id");
  vtkDataArray *losses_read = grid->GetCellData()->GetArray("loss_1");
  ASSERT_TRUE(ids_read && losses_read);
  double volume = 0.;
  for (vtkIdType k = 0; k < grid->GetNumberOfCells(); ++k)
  {
    const std::size_t particle = k < 1280 ? 0 : 1;
    EXPECT_EQ(ids_read->GetTuple1(k), static_cast<double>(ids[particle]));
    EXPECT_NEAR(losses_read->GetTuple1(k), losses[particle], rounding);
    vtkPoints *corners = grid->GetCell(k)->GetPoints();
    if (particle == 0)
      volume += Vec3(corners->GetPoint(0))
                    .dot(Vec3(corners->GetPoint(1))
                             .cross(Vec3(corners->GetPoint(2)))) /
                6.;
  }
  // The flat triangles lie inside the sphere: 1280 of them lose 1 %.
  const double sphere = 4. / 3. * std::numbers::pi * 1e-6;
  EXPECT_NEAR(volume, sphere, 0.015 * sphere);
}

TEST(VtkOutput, ContactsAreLinesWithForces)
{
  const std::vector<dem::ContactLine> contacts{
      {.from = Vec3::Zero(), .to = Vec3::UnitX(), .normal_force = 5.},
      {.from = Vec3::UnitY(),
       .to = Vec3::UnitZ(),
       .normal_force = 12.,
       .shear_force = 3.,
       .overlap = 1e-5,
       .kind = dem::ContactKind::particle_facet}};
  const std::string path = scratch("contacts.vtu");
  write(path, dem::write_contacts, contacts);
  const auto reader = read(path);
  vtkUnstructuredGrid *grid = reader->GetOutput();
  ASSERT_EQ(grid->GetNumberOfCells(), 2);
  EXPECT_EQ(grid->GetPoint(3)[2], 1.);
  vtkCellData *data = grid->GetCellData();
  EXPECT_EQ(data->GetArray("normal_force_N")->GetTuple1(1), 12.);
  EXPECT_EQ(data->GetArray("shear_force_N")->GetTuple1(1), 3.);
  EXPECT_NEAR(data->GetArray("overlap_m")->GetTuple1(1), 1e-5, 1e-11);
  EXPECT_EQ(data->GetArray("kind")->GetTuple1(1), 2.);
  vtkDataArray *at_ends = grid->GetPointData()->GetArray("normal_force_N");
  EXPECT_EQ(at_ends->GetTuple1(1), 5.);
  EXPECT_EQ(at_ends->GetTuple1(2), 12.);
}

// A quarter turn after it pointed up the lifter of a drum about y points to +x.
TEST(VtkOutput, DrumTurnsWithItsLifter)
{
  dem::Drum drum;
  drum.centre = {0.1, 0.2, 0.3};
  drum.radius = 0.5;
  drum.length = 0.4;
  drum.lifter_height = 0.1;
  drum.lifter_thickness = 0.02;
  drum.angle = 0.5 * std::numbers::pi;
  const std::string path = scratch("drum.vtu");
  write(path, dem::write_drum, drum);
  const auto reader = read(path);
  vtkUnstructuredGrid *grid = reader->GetOutput();
  ASSERT_EQ(grid->GetNumberOfCells(), 72 + 3);
  int n_tip = 0;
  for (vtkIdType k = 0; k < grid->GetNumberOfPoints(); ++k)
  {
    const Vec3 arm = Vec3(grid->GetPoint(k)) - drum.centre;
    EXPECT_NEAR(std::abs(arm.y()), 0.2, rounding);
    const double distance = std::hypot(arm.x(), arm.z());
    const bool is_of_lifter = std::abs(distance - 0.5) > rounding;
    n_tip += is_of_lifter && std::abs(arm.x() - 0.4) < rounding &&
             std::abs(std::abs(arm.z()) - 0.01) < rounding;
    EXPECT_TRUE(!is_of_lifter || arm.x() > 0.39) << arm.transpose();
  }
  EXPECT_EQ(n_tip, 4);
}

/// Cells and points of the index of two pieces.
void expect_pieces(dem::FramePart part, const std::string &one,
                   const std::string &other, vtkIdType n_cells,
                   const std::vector<const char *> &point_data,
                   const std::vector<const char *> &cell_data)
{
  const std::string index = scratch("index.pvtu");
  std::ofstream file(index);
  dem::write_piece_index(file, part, std::vector{one, other});
  file.close();
  vtkNew<vtkXMLPUnstructuredGridReader> reader;
  reader->SetFileName(index.c_str());
  reader->Update();
  vtkUnstructuredGrid *grid = reader->GetOutput();
  EXPECT_EQ(grid->GetNumberOfCells(), n_cells);
  EXPECT_EQ(grid->GetPointData()->GetNumberOfArrays(),
            static_cast<int>(point_data.size()));
  for (const char *name : point_data)
    EXPECT_EQ(grid->GetPointData()->GetArray(name)->GetNumberOfTuples(),
              grid->GetNumberOfPoints())
        << name;
  for (const char *name : cell_data)
    EXPECT_EQ(grid->GetCellData()->GetArray(name)->GetNumberOfTuples(), n_cells)
        << name;
}

// One of the pieces is that of a rank that has no particles.
TEST_F(TwoParticles, IndexIsReadAsOneGrid)
{
  const dem::ParticleColumns none;
  write(scratch("some.vtu"), dem::write_particles, columns());
  write(scratch("none.vtu"), dem::write_particles, none);
  expect_pieces(dem::FramePart::particles, "some.vtu", "none.vtu", 2,
                {"id", "radius_m", "mass_kg", "loss_1", "volume_m3",
                 "inscribed_radius_m", "velocity_m_per_s", "spin_rad_per_s",
                 "orientation_wxyz"},
                {});
  write(scratch("some.vtu"), dem::write_surfaces, columns());
  write(scratch("none.vtu"), dem::write_surfaces, none);
  expect_pieces(dem::FramePart::surfaces, "none.vtu", "some.vtu", 2 * 1280, {},
                {"id", "loss_1"});
  const std::vector<dem::ContactLine> line{
      {.from = Vec3::Zero(), .to = Vec3::UnitX(), .normal_force = 5.}};
  write(scratch("some.vtu"), dem::write_contacts, line);
  expect_pieces(dem::FramePart::contacts, "some.vtu", "some.vtu", 2,
                {"normal_force_N"},
                {"normal_force_N", "shear_force_N", "overlap_m", "kind"});
}

TEST(VtkOutput, NoParticlesAndNoContactsAreFiles)
{
  const dem::ParticleColumns none;
  write(scratch("no_particles.vtu"), dem::write_particles, none);
  write(scratch("no_surfaces.vtu"), dem::write_surfaces, none);
  write(scratch("no_contacts.vtu"), dem::write_contacts,
        std::vector<dem::ContactLine>());
  for (const char *name :
       {"no_particles.vtu", "no_surfaces.vtu", "no_contacts.vtu"})
    EXPECT_EQ(read(scratch(name))->GetOutput()->GetNumberOfCells(), 0);
}

TEST(VtkOutput, CollectionListsEveryFrame)
{
  const std::vector<dem::FrameEntry> entries{
      {.time = 0.1, .part = 0, .file = "frames/particles_00000.vtu"},
      {.time = 0.1, .part = 2, .file = "frames/membrane_00000.vtu"}};
  const std::string text = dem::collection_text(entries);
  EXPECT_NE(text.find("part=\"2\" file=\"frames/membrane_00000.vtu\""),
            std::string::npos);
  EXPECT_NE(text.find("timestep=\"0.1"), std::string::npos);
}
} // namespace
