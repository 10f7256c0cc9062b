#include <dem/boundary/drum_contacts.h>
#include <dem/contact/common_normal.h>
#include <dem/engine_boundaries.h>
#include <dem/measure/assembly.h>
#include <dem/measure/wall_frame.h>

namespace dem
{
namespace
{
/// Shear springs at the Coulomb limit are there to round-off; dashpots that
/// belong to the limit are kept to seven digits.
constexpr double at_limit = 1. - 1e-5;

Vec3 vector_of(const Triple<double> &v)
{
  return {v.x, v.y, v.z};
}

/// The surface of particle A where contact k presses: it follows the surfaces.
SurfacePoint contact_point_on_a(const ParticleSystem &particles,
                                const ContactBatch &batch, std::size_t k)
{
  const auto a = static_cast<std::size_t>(batch.a[k]);
  SurfacePoint contact_point =
      turned(surface_point(particles.shape[a], batch.side_a.contact_point(k)),
             particles.rotation(a));
  contact_point.position += particles.position(a);
  return contact_point;
}

bool is_at_limit(const EngineParameters &parameters, const ContactBatch &pairs,
                 std::size_t k, const Vec3 &normal)
{
  double pressing = pairs.pressing_force(k);
  if (parameters.friction_limit == FrictionLimit::total)
    pressing -= vector_of(pairs.dashpot[k]).dot(normal);
  return vector_of(pairs.shear[k]).norm() >=
         at_limit * parameters.particle.friction * pressing;
}

/// `entries` are of one pair of particles; false if none bears a force.
bool join_contacts(const Engine &engine, std::span<const std::int32_t> entries,
                   PairContact &contact)
{
  const ContactBatch &pairs = engine.pairs();
  const auto first = static_cast<std::size_t>(entries.front());
  contact = {pairs.a[first], pairs.b[first], Vec3::Zero(),
             Vec3::Zero(),   Vec3::Zero(),   true};
  double weight = 0.;
  for (const std::int32_t entry : entries)
  {
    const auto k = static_cast<std::size_t>(entry);
    if (!pairs.has_force(k))
      continue;
    const ContactFrame frame = pair_contact_frame(engine, k);
    const double share = std::abs(pairs.normal_force[k]);
    contact.normal += share * frame.normal;
    contact.point += share * frame.point;
    contact.force += pair_force(engine.particles(), pairs, k);
    contact.is_sliding &=
        is_at_limit(engine.parameters(), pairs, k, frame.normal);
    weight += share;
  }
  if (weight <= 0.)
    return false;
  contact.normal.normalize();
  contact.point /= weight;
  return true;
}

/// `facets` that the batch is of; null: planes or drum.
void add_walls(const Engine &engine, const ContactBatch &batch,
               const FacetBoundary *facets, std::vector<WallContact> &walls)
{
  for (std::size_t k = 0; k < batch.size(); ++k)
    if (batch.is_touching(k) || !batch.load[k].force.isZero(0.))
      walls.push_back({batch.a[k], wall_contact_point(engine, batch, k),
                       batch.load[k].force,
                       facets ? facets->spread_of(k) : Mat3(Mat3::Zero()),
                       facets != nullptr});
}
} // namespace

ContactFrame pair_contact_frame(const Engine &engine, std::size_t k)
{
  const ParticleSystem &particles = engine.particles();
  const ContactBatch &pairs = engine.pairs();
  if (pairs.layout.has_contact_points)
  {
    const SurfacePoint contact_point = contact_point_on_a(particles, pairs, k);
    return {contact_point.position -
                0.5 * pairs.overlap[k] * contact_point.normal,
            contact_point.normal};
  }
  const auto a = static_cast<std::size_t>(pairs.a[k]),
             b = static_cast<std::size_t>(pairs.b[k]);
  const Vec3 normal = particles.branch(a, b).normalized();
  double radius = particles.radius(a);
  if (traits(engine.parameters().geometry.geometry).is_along_branch &&
      pairs.side_a.is_known(k))
  {
    const Vec3 u = particles.orientation(a).conjugate() * normal;
    radius = pairs.side_a.local_radius(k, {u.x(), u.y(), u.z()});
  }
  return {particles.position(a) + (radius - 0.5 * pairs.overlap[k]) * normal,
          normal};
}

Vec3 wall_contact_point(const Engine &engine, const ContactBatch &batch,
                        std::size_t k)
{
  for (const FacetBoundary &facets : all_facets(engine))
    if (&batch == &facets.batch)
      return facets.point_of(k);
  const ParticleSystem &particles = engine.particles();
  if (batch.layout.has_contact_points)
    return contact_point_on_a(particles, batch, k).position;
  const Vec3 &from = particles.position(static_cast<std::size_t>(batch.a[k]));
  if (&batch == &on_drum(engine))
    return nearest_on_drum(drum(engine), drum_part(batch, k), from).point;
  const Plane &plane = planes(engine)[static_cast<std::size_t>(batch.b[k])];
  return from - (from - plane.point).dot(plane.normal) * plane.normal;
}

ContactFrame wall_contact_frame(const Engine &engine, const ContactBatch &batch,
                                std::size_t k)
{
  const ParticleSystem &particles = engine.particles();
  const Vec3 point = wall_contact_point(engine, batch, k);
  if (batch.layout.has_contact_points)
    return {point, contact_point_on_a(particles, batch, k).normal};
  const Vec3 &from = particles.position(static_cast<std::size_t>(batch.a[k]));
  if (&batch == &on_planes(engine))
    return {point,
            -planes(engine)[static_cast<std::size_t>(batch.b[k])].normal};
  if (&batch == &on_drum(engine))
    return {point,
            nearest_on_drum(drum(engine), drum_part(batch, k), from).normal};
  return {point, (point - from).normalized()};
}

Network contact_network_of(const Engine &engine)
{
  Network network;
  PairContact contact;
  for_each_pair(engine.pairs(),
                [&](std::span<const std::int32_t> entries)
                {
                  if (join_contacts(engine, entries, contact))
                    network.pairs.push_back(contact);
                });
  add_walls(engine, on_planes(engine), nullptr, network.walls);
  add_walls(engine, on_drum(engine), nullptr, network.walls);
  for (const FacetBoundary &facets : all_facets(engine))
    add_walls(engine, facets.batch, &facets, network.walls);
  return network;
}
} // namespace dem
