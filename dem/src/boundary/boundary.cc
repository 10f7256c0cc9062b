#include <dem/binary.h>
#include <dem/boundary/boundary.h>
#include <dem/boundary/drum_boundary.h>
#include <dem/boundary/facet_boundary.h>
#include <dem/boundary/mesh_wall.h>
#include <dem/boundary/plane_boundary.h>
#include <dem/contact/batch_stream.h>
#include <dem/neighbor/candidate_pair.h>

#include <map>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace dem
{
namespace
{
using Make = std::function<std::unique_ptr<Boundary>()>;

/// The kinds by name: one line for each of the library.
std::map<std::string, Make> &kinds()
{
  static std::map<std::string, Make> all = {
      {PlaneBoundary::kind_name, std::make_unique<PlaneBoundary>},
      {DrumBoundary::kind_name, std::make_unique<DrumBoundary>},
      {FacetBoundary::kind_name, std::make_unique<FacetBoundary>},
      {MeshWall::kind_name, std::make_unique<MeshWall>},
  };
  return all;
}

/// All but the name of the law.
template <class Material, class Visit>
void visit_material(Material &material, const Visit &visit)
{
  visit(material.normal_stiffness);
  visit(material.shear_stiffness);
  visit(material.friction);
  visit(material.rolling_friction);
  visit(material.normal_damping);
  visit(material.shear_damping);
  visit(material.law_values);
}
} // namespace

void Boundary::pack(std::ostream &out) const
{
  write_name(out, material.law);
  visit_material(material,
                 [&out](const auto &field) { write_value(out, field); });
  write_batch(out, batch);
  write_value(out, friction);
  pack_parts(out);
}

void Boundary::unpack(std::istream &in)
{
  material.law = read_name(in);
  visit_material(material, [&in](auto &field) { read_value(in, field); });
  read_batch(in, batch);
  read_value(in, friction);
  unpack_parts(in);
}

void Boundary::renumber(const std::vector<std::int32_t> &new_row)
{
  for (std::size_t k = 0; k < batch.size(); ++k)
    batch.a[k] = new_row[static_cast<std::size_t>(batch.a[k])];
  sort_contacts();
  if (std::vector<CandidatePair> *pairs = candidates())
    renumber_candidates(new_row, *pairs);
  keep_particles(new_row);
}

std::unique_ptr<Boundary> Boundary::copy() const
{
  std::stringstream bytes;
  pack(bytes);
  std::unique_ptr<Boundary> made = make_boundary(kind());
  made->unpack(bytes);
  return made;
}

void Boundary::keep_contacts(const std::vector<std::int32_t> &order)
{
  batch = batch.select(order);
}

std::vector<std::int32_t> Boundary::sort_contacts()
{
  std::vector<std::int32_t> order = batch.by_pair();
  batch.rearrange(batch.layout, order);
  return order;
}

void Boundary::swap_contacts(Boundary &other)
{
  std::swap(batch, other.batch);
}

void Boundary::take_contact(std::size_t k, const Boundary &other, std::size_t l)
{
  ContactBatch one = other.batch.extract(l);
  one.a[0] = batch.a[k];
  one.b[0] = batch.b[k];
  batch.replace(k, one);
}

bool follows_surfaces(const ForceContext &context)
{
  return context.particles.has_shapes &&
         traits(context.parameters.geometry.wall_geometry).has_common_normal;
}

void add_boundary_kind(const std::string &kind, Make make)
{
  if (!kinds().emplace(kind, std::move(make)).second)
    throw std::invalid_argument("there is a kind of boundary " + kind);
}

std::unique_ptr<Boundary> make_boundary(const std::string &kind)
{
  const auto found = kinds().find(kind);
  if (found == kinds().end())
    throw std::runtime_error("checkpoint: no kind of boundary " + kind);
  return found->second();
}
} // namespace dem
