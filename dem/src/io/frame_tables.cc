#include <dem/engine_boundaries.h>
#include <dem/io/frame_tables.h>
#include <dem/measure/assembly.h>
#include <dem/measure/wall_frame.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>

namespace dem
{
namespace
{
/// Column `shape` of particles without a row in the table of shapes.
constexpr std::int32_t is_sphere = -1, has_own_surface = -2;
/// Columns `b_id` and `boundary` where B is no particle, or no boundary.
constexpr std::int32_t no_row = -1;

/// Column `kind` of contacts and boundaries.
enum ContactWith : std::int32_t
{
  with_particle,
  with_plane,
  with_drum,
  with_facets
};

using Rows = std::vector<std::size_t>;

template <class Number, class Value>
TableColumn scalars(const char *name, const char *unit, const char *sentence,
                    const Rows &rows, const Value &value)
{
  std::vector<Number> values;
  values.reserve(rows.size());
  for (const std::size_t row : rows)
    values.push_back(static_cast<Number>(value(row)));
  return {name, unit, sentence, std::move(values)};
}

/// `value(row)` is a vector with n_components entries.
template <class Value>
TableColumn vectors(const char *name, const char *unit, const char *sentence,
                    const Rows &rows, const Value &value)
{
  std::vector<double> values;
  std::size_t n = 3;
  for (const std::size_t row : rows)
  {
    const auto entry = value(row);
    n = static_cast<std::size_t>(entry.size());
    values.insert(values.end(), entry.data(), entry.data() + n);
  }
  return {name, unit, sentence, std::move(values), n};
}

Rows rows_by_id(const ParticleSystem &particles)
{
  Rows rows(particles.size());
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  std::ranges::sort(rows, {},
                    [&](std::size_t row) { return particles.id[row]; });
  return rows;
}

std::vector<std::int32_t> shape_rows(const ParticleSystem &particles,
                                     const FrameDescription &frame)
{
  std::map<const Coefficients *, std::int32_t> known = {{nullptr, is_sphere}};
  for (std::size_t k = 0; k < frame.shapes.size(); ++k)
    known.emplace(frame.shapes[k].get(), static_cast<std::int32_t>(k));
  std::vector<std::int32_t> all;
  for (const ParticleShape &shape : particles.shape)
  {
    const auto found = known.find(shape.series.get());
    all.push_back(found == known.end() ? has_own_surface : found->second);
  }
  return all;
}

/// Particles that each particle touches [-].
std::vector<std::int32_t> coordination_numbers(const ParticleSystem &particles,
                                               const Network &network)
{
  std::vector<std::int32_t> number(particles.size(), 0);
  for (const PairContact &contact : network.pairs)
  {
    ++number[static_cast<std::size_t>(contact.a)];
    ++number[static_cast<std::size_t>(contact.b)];
  }
  return number;
}

TableGroup particle_table(const Engine &engine, const FrameDescription &frame)
{
  const ParticleSystem &all = engine.particles();
  const Rows rows = rows_by_id(all);
  const Network network = contact_network_of(engine);
  const std::vector<Mat3> stress = particle_stress(all, network);
  const auto coordination = coordination_numbers(all, network);
  const auto shape = shape_rows(all, frame);
  const auto loss = [&](std::size_t k)
  { return 1. - all.solid_mass(k) / all.initial_mass[k]; };
  using Six = Eigen::Matrix<double, 6, 1>;
  const auto six = [&](std::size_t k)
  {
    const Mat3 &s = stress[k];
    return Six((Six() << s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(0, 2), s(1, 2))
                   .finished());
  };
  TableGroup table{"particles", {}};
  auto &c = table.columns;
  c.push_back(scalars<std::int64_t>("id", "1", "Number of the particle.", rows,
                                    [&](std::size_t k) { return all.id[k]; }));
  c.push_back(vectors("position_m", "m", "Origin of the particle.", rows,
                      [&](std::size_t k) { return all.position(k); }));
  c.push_back(vectors("velocity_m_per_s", "m/s", "Velocity of that point.",
                      rows, [&](std::size_t k) { return all.velocity(k); }));
  c.push_back(vectors("spin_rad_per_s", "rad/s",
                      "Angular velocity in the world frame.", rows,
                      [&](std::size_t k) { return all.spin(k); }));
  c.push_back(vectors("orientation_wxyz", "1",
                      "Unit quaternion w, x, y, z from the frame of the body "
                      "to the world.",
                      rows,
                      [&](std::size_t k)
                      {
                        const Quaternion &q = all.orientation(k);
                        return Eigen::Vector4d(q.w(), q.x(), q.y(), q.z());
                      }));
  c.push_back(scalars<double>("radius_m", "m",
                              "Radius of the equivalent sphere.", rows,
                              [&](std::size_t k) { return all.radius(k); }));
  c.push_back(scalars<double>(
      "inscribed_radius_m", "m",
      "Radius of the inscribed sphere about the origin.", rows,
      [&](std::size_t k) { return all.shape[k].inscribed_radius; }));
  c.push_back(
      scalars<double>("mass_kg", "kg", "Mass without density scaling.", rows,
                      [&](std::size_t k) { return all.solid_mass(k); }));
  c.push_back(scalars<double>("volume_m3", "m^3", "Volume.", rows,
                              [&](std::size_t k)
                              { return all.shape[k].volume; }));
  c.push_back(scalars<double>(
      "loss_1", "1", "Removed mass over the initial mass.", rows, loss));
  c.push_back(scalars<double>(
      "removed_volume_m3", "m^3", "Volume removed by breakage.", rows,
      [&](std::size_t k)
      {
        const double removed = all.initial_mass[k] / all.solid_mass(k);
        return all.shape[k].volume * (removed - 1.);
      }));
  c.push_back(scalars<std::int32_t>(
      "coordination_number_1", "1", "Number of particles that it touches.",
      rows, [&](std::size_t k) { return coordination[k]; }));
  c.push_back(vectors("stress_Pa", "Pa",
                      "Mean stress xx, yy, zz, xy, xz, yz, compression "
                      "positive.",
                      rows, six));
  c.push_back(scalars<std::int32_t>(
      "shape", "1",
      "Row of the table shapes; -1: a sphere, -2: a surface of its own, since "
      "it has broken.",
      rows, [&](std::size_t k) { return shape[k]; }));
  c.push_back(scalars<std::int32_t>(
      "material", "1", "0: section Particle, others: the other material.", rows,
      [&](std::size_t k) { return all.material[k]; }));
  return table;
}

struct ContactRow
{
  std::int64_t a = 0, b = no_row; ///< ids
  ContactWith with = with_particle;
  std::int32_t boundary = no_row;
  ContactFrame frame;
  double overlap = 0.;       ///< [m]
  Vec3 force = Vec3::Zero(); ///< on A [N]

  auto key() const { return std::tuple(a, b, boundary); }
  double normal_force() const { return -force.dot(frame.normal); }
  Vec3 shear_force() const { return force + normal_force() * frame.normal; }
};

/// Contacts, and the boundaries in the order of their rows.
class Contacts
{
public:
  Contacts(const Engine &of, const FrameDescription &its_frame)
      : engine(of), frame(its_frame)
  {
    add_pairs();
    add_planes();
    if (find_boundary<DrumBoundary>(engine))
      add_boundary(on_drum(engine), with_drum, "drum");
    for (const FacetBoundary &facets : all_facets(engine))
      add_boundary(facets.batch, with_facets, facets.label);
    std::ranges::stable_sort(rows, {}, &ContactRow::key);
  }

  TableGroup table() const;
  TableGroup boundary_table() const;

private:
  std::int64_t id(std::int32_t row) const
  {
    return engine.particles().id[static_cast<std::size_t>(row)];
  }
  void add_pairs()
  {
    const ContactBatch &pairs = engine.pairs();
    for_each_pair(pairs,
                  [&](std::span<const std::int32_t> entries)
                  {
                    for (const std::int32_t entry : entries)
                      add_pair(pairs, static_cast<std::size_t>(entry));
                  });
  }
  void add_pair(const ContactBatch &pairs, std::size_t k)
  {
    if (pairs.has_force(k))
      rows.push_back({id(pairs.a[k]), id(pairs.b[k]), with_particle, no_row,
                      pair_contact_frame(engine, k), pairs.overlap[k],
                      pair_force(engine.particles(), pairs, k)});
  }
  void add_wall_contact(const ContactBatch &batch, std::size_t k,
                        ContactWith with, std::int32_t boundary)
  {
    if (batch.has_force(k))
      rows.push_back({id(batch.a[k]), no_row, with, boundary,
                      wall_contact_frame(engine, batch, k), batch.overlap[k],
                      batch.load[k].force});
  }
  void add_planes()
  {
    const std::size_t n = planes(engine).size();
    const ContactBatch &batch = on_planes(engine);
    for (std::size_t k = 0; k < n; ++k)
    {
      const bool is_named =
          k < frame.plane_names.size() && !frame.plane_names[k].empty();
      names.push_back(is_named ? frame.plane_names[k]
                               : "plane_" + std::to_string(k));
      kinds.push_back(with_plane);
    }
    for (std::size_t k = 0; k < batch.size(); ++k)
      add_wall_contact(batch, k, with_plane, batch.b[k]);
  }
  void add_boundary(const ContactBatch &batch, ContactWith with,
                    const std::string &name)
  {
    const auto row = static_cast<std::int32_t>(names.size());
    names.push_back(name);
    kinds.push_back(with);
    for (std::size_t k = 0; k < batch.size(); ++k)
      add_wall_contact(batch, k, with, row);
  }

  const Engine &engine;
  const FrameDescription &frame;
  std::vector<ContactRow> rows;
  std::vector<std::string> names;
  std::vector<std::int32_t> kinds;
};

TableGroup Contacts::table() const
{
  Rows order(rows.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  TableGroup table{"contacts", {}};
  auto &c = table.columns;
  c.push_back(scalars<std::int64_t>("a_id", "1", "Number of particle A.", order,
                                    [&](std::size_t k) { return rows[k].a; }));
  c.push_back(scalars<std::int64_t>(
      "b_id", "1", "Number of particle B; -1: a boundary.", order,
      [&](std::size_t k) { return rows[k].b; }));
  c.push_back(scalars<std::int32_t>(
      "kind", "1", "What B is: 0 particle, 1 plane, 2 drum, 3 facets.", order,
      [&](std::size_t k) { return rows[k].with; }));
  c.push_back(scalars<std::int32_t>(
      "boundary", "1", "Row of the table boundaries; -1: B is a particle.",
      order, [&](std::size_t k) { return rows[k].boundary; }));
  c.push_back(vectors("point_m", "m", "Contact point.", order,
                      [&](std::size_t k) { return rows[k].frame.point; }));
  c.push_back(vectors("normal_1", "1", "Unit normal from A to B.", order,
                      [&](std::size_t k) { return rows[k].frame.normal; }));
  c.push_back(scalars<double>("overlap_m", "m", "Overlap; 0 across a gap.",
                              order,
                              [&](std::size_t k) { return rows[k].overlap; }));
  c.push_back(scalars<double>(
      "normal_force_N", "N", "Normal force, compression positive.", order,
      [&](std::size_t k) { return rows[k].normal_force(); }));
  c.push_back(vectors("shear_force_N", "N", "Tangential force on A.", order,
                      [&](std::size_t k) { return rows[k].shear_force(); }));
  return table;
}

TableGroup Contacts::boundary_table() const
{
  return {"boundaries",
          {{"name", "1", "Name of the boundary.", names},
           {"kind", "1", "1 plane, 2 drum, 3 facets.", kinds}}};
}
} // namespace

TableFile frame_tables(const Engine &engine, const FrameDescription &frame)
{
  TableFile file;
  file.attributes = {{"schema", std::string("spall_frame_tables")},
                     {"schema_version", frame_tables_version},
                     {"spall_version", frame.program},
                     {"case_title", frame.title},
                     {"case_kind", frame.kind},
                     {"frame", frame.number},
                     {"step", engine.n_steps()},
                     {"time_s", engine.time()}};
  if (engine.cell().is_there())
  {
    file.attributes.emplace_back("periodic_cell_centre_m",
                                 engine.cell().centre);
    file.attributes.emplace_back("periodic_cell_length_m",
                                 engine.cell().length);
  }
  const Contacts contacts(engine, frame);
  file.groups = {particle_table(engine, frame),
                 contacts.table(),
                 contacts.boundary_table(),
                 {"shapes",
                  {{"name", "1", "Name of the shape file without ending.",
                    frame.shape_names}}}};
  return file;
}
} // namespace dem
