#include "spring_contact.h"

#include <dem/boundary/drum_contacts.h>
#include <dem/contact/common_normal.h>
#include <dem/contact/law_table.h>
#include <dem/engine_boundaries.h>
#include <dem/measure/contact_springs.h>
#include <dem/parallel/distribution.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dem
{
namespace
{
/// Radius of the particle towards a world direction, as the last step left it.
double reach_of(const ParticleSystem &particles, std::int32_t particle,
                const SideColumns &side, std::size_t k, const Vec3 &direction)
{
  const auto i = static_cast<std::size_t>(particle);
  const Vec3 on_body = particles.orientation(i).conjugate() * direction;
  return side.is_known(k)
             ? side.local_radius(k, {on_body.x(), on_body.y(), on_body.z()})
             : particles.radius(i);
}

/// Prefactors of a contact: as mixed, or, if it has not touched yet, of spheres
/// with these curvatures.
HertzPrefactors prefactors_of(const ContactBatch &batch, std::size_t k,
                              const PairElasticity &elasticity, double kappa_a,
                              double kappa_b)
{
  if (!batch.normal_prefactor.empty() && batch.normal_prefactor[k] > 0.)
    return {batch.normal_prefactor[k], batch.shear_prefactor[k]};
  return elliptic_table()(
      elasticity, gap_coefficients({kappa_a, kappa_a, kappa_b, kappa_b, 1.}));
}

/// How two particles, or a particle and a wall, stand to each other at one
/// contact.
struct Stand
{
  Vec3 normal = Vec3::UnitX();
  /// From the centres to the contact point, which is half way in the overlap.
  Vec3 lever_a = Vec3::Zero(), lever_b = Vec3::Zero(); ///< [m]
  double overlap = 0.;                                 ///< < 0: a gap [m]
};

/// `lever` less `share` of the overlap (none in a gap), towards the centre.
Vec3 shortened(const Vec3 &lever, double share, double overlap,
               const Vec3 &normal)
{
  return lever - share * std::max(0., overlap) * normal;
}

/// 1/R = 1/r_A + 1/r_B with the distances from centre to contact point [m].
double rolling_radius(const Stand &at)
{
  const double r_a = at.lever_a.norm(), r_b = at.lever_b.norm();
  return r_a * r_b / (r_a + r_b);
}

/// Where the true surface of a particle has its contact, world frame.
SurfacePoint point_of(const ParticleSystem &particles, std::int32_t particle,
                      const SideColumns &side, std::size_t k)
{
  const auto i = static_cast<std::size_t>(particle);
  const SurfacePoint on_body =
      side.is_known(k)
          ? side.surface_at_contact_point(k)
          : surface_point(particles.shape[i], side.contact_point(k));
  return turned(on_body, particles.rotation(i));
}

Stand true_stand(const ParticleSystem &particles, const ContactBatch &batch,
                 std::size_t k)
{
  const SurfacePoint a = point_of(particles, batch.a[k], batch.side_a, k);
  const SurfacePoint b = point_of(particles, batch.b[k], batch.side_b, k);
  const Vec3 branch = particles.branch(static_cast<std::size_t>(batch.a[k]),
                                       static_cast<std::size_t>(batch.b[k]));
  const double depth = (a.position - branch - b.position).dot(a.normal);
  return {a.normal, shortened(a.position, 0.5, depth, a.normal),
          shortened(b.position, 0.5, depth, -a.normal),
          depth - batch.overlap_offset[k]};
}

/// Along the branch, by spheres or local radii; no overlap if centres coincide.
Stand branch_stand(const ParticleSystem &particles, const ContactBatch &batch,
                   std::size_t k, bool is_radial)
{
  const auto i = static_cast<std::size_t>(batch.a[k]),
             j = static_cast<std::size_t>(batch.b[k]);
  const Vec3 branch = particles.branch(i, j);
  const double distance = branch.norm();
  if (distance <= 0.)
    return {};
  const Vec3 n = branch / distance;
  const double r_a = is_radial
                         ? reach_of(particles, batch.a[k], batch.side_a, k, n)
                         : particles.radius(i);
  const double r_b = is_radial
                         ? reach_of(particles, batch.b[k], batch.side_b, k, -n)
                         : particles.radius(j);
  const double overlap = r_a + r_b - distance;
  return {n, shortened(r_a * n, 0.5, overlap, n),
          shortened(-r_b * n, 0.5, overlap, -n), overlap};
}

/// The springs of a contact at the overlap that it may come to, and what its
/// normal spring holds now. `radius`: of Prefactors [m].
void set_springs(const LawChoice &law, const HertzPrefactors &prefactors,
                 double radius, double overlap, double overlap_now,
                 SpringContact &c)
{
  const ContactLaw &entry = law.entry();
  const Prefactors<double> of{prefactors.normal, prefactors.tangential, radius};
  const NormalSpring<double> spring =
      entry.spring(law.values, of, std::max(0., overlap));
  c.normal_stiffness = spring.stiffness;
  c.shear_stiffness = spring.shear_stiffness;
  // The attraction changes as steeply across its range.
  if (entry.attracts)
    c.normal_stiffness += spring.attraction / law.range();
  if (!entry.scales_with_curvature)
    return;
  const double depth = std::max(0., overlap_now);
  const NormalSpring<double> now = entry.spring(law.values, of, depth);
  c.hertz_prefactor = prefactors.normal;
  c.stored = entry.energy(law.values, now.force + now.attraction, depth);
}

/// Velocities of all rows, those of ghosts as their owners have them now.
std::vector<Vec3> velocities_of(const Engine &engine)
{
  std::vector<Vec3> velocities =
      engine.particles().column(&ParticleState::velocity);
  engine.distribution().exchange().fill(velocities);
  return velocities;
}

void add_pairs(const Engine &engine, const Foresight &ahead,
               SpringNetwork &network)
{
  const std::vector<Vec3> velocities = velocities_of(engine);
  const ParticleSystem &particles = engine.particles();
  const ContactBatch &batch = engine.pairs();
  const ParticleMaterial &particle = engine.parameters().particle;
  const ElasticityTable elasticity(engine.parameters());
  const bool is_radial =
      traits(engine.parameters().geometry.geometry).is_along_branch;
  const double range = batch.layout.law.range();
  for (std::size_t k = 0; k < batch.size(); ++k)
  {
    const auto i = static_cast<std::size_t>(batch.a[k]),
               j = static_cast<std::size_t>(batch.b[k]);
    const Stand stand = batch.layout.has_contact_points
                            ? true_stand(particles, batch, k)
                            : branch_stand(particles, batch, k, is_radial);
    const double r_a = stand.lever_a.norm(), r_b = stand.lever_b.norm();
    const Vec3 velocity = particles.cell.is_there()
                              ? particles.relative_velocity(i, j)
                              : Vec3(velocities[j] - velocities[i]);
    const double half = 0.5 * std::max(0., stand.overlap);
    const double overlap = stand.overlap + ahead.horizon * velocity.norm();
    if (overlap <= -range || r_a + r_b <= 0.)
      continue;
    const HertzPrefactors prefactors = prefactors_of(
        batch, k, elasticity.pair(particles.material[i], particles.material[j]),
        1. / (r_a + half), 1. / (r_b + half));
    SpringContact c;
    set_springs(batch.layout.law, prefactors, r_a * r_b / (r_a + r_b), overlap,
                stand.overlap, c);
    c.a = batch.a[k];
    c.b[0] = {batch.b[k], 1.};
    c.normal = stand.normal;
    c.lever_a = stand.lever_a;
    c.lever_b = stand.lever_b;
    c.closing_speed = -velocity.dot(stand.normal);
    c.rolling_radius = rolling_radius(stand);
    c.reduced_mass = particles.mass(i) * particles.mass(j) /
                     (particles.mass(i) + particles.mass(j));
    c.coefficients = coefficients_of(particle);
    append(network, c, ahead);
  }
}

/// What a wall is to a particle with this lever to the contact point, but for
/// the springs.
SpringContact wall_contact(const WallMaterial &wall, const Vec3 &lever,
                           const Vec3 &normal)
{
  SpringContact c;
  c.normal = normal;
  c.lever_a = lever;
  c.rolling_radius = lever.norm();
  c.coefficients = coefficients_of(wall);
  return c;
}

/// From the centre to where the surface of the particle of contact k meets a
/// wall.
Vec3 wall_lever(const Engine &engine, const ContactBatch &batch, std::size_t k,
                const Vec3 &normal)
{
  const ParticleSystem &particles = engine.particles();
  if (batch.layout.has_contact_points && batch.side_a.is_known(k))
    return point_of(particles, batch.a[k], batch.side_a, k).position;
  const bool is_radial =
      traits(engine.parameters().geometry.wall_geometry).is_along_branch;
  return (is_radial ? reach_of(particles, batch.a[k], batch.side_a, k, normal)
                    : particles.radius(static_cast<std::size_t>(batch.a[k]))) *
         normal;
}

/// From there back to the contact point: to the wall, or half way where true
/// surfaces meet. `overlap` of the surfaces [m].
Vec3 lever_at_wall(const ContactBatch &batch, const Vec3 &to_surface,
                   double overlap, const Vec3 &normal)
{
  return shortened(to_surface, batch.layout.has_contact_points ? 0.5 : 1.,
                   overlap, normal);
}

/// Overlap of contact k that carries nothing [m].
double overlap_offset_of(const ContactBatch &batch, std::size_t k)
{
  return batch.layout.has_contact_points ? batch.overlap_offset[k] : 0.;
}

/// How a particle and a wall meet at one contact.
struct WallMeeting
{
  double overlap = 0.;       ///< now; < 0: a gap [m]
  double grown = 0.;         ///< overlap at the horizon [m]
  double closing_speed = 0.; ///< now [m/s]
};

/// The springs of contact k with a wall at the horizon; a law that scales with
/// curvature sees a rigid plate.
void set_wall_springs(const Engine &engine, const ContactBatch &batch,
                      std::size_t k, const WallMeeting &at, SpringContact &c)
{
  if (!batch.layout.law.entry().scales_with_curvature)
    return set_springs(batch.layout.law, {}, 0., at.grown, at.overlap, c);
  const auto i = static_cast<std::size_t>(batch.a[k]);
  const ElasticityTable elasticity(engine.parameters());
  const double radius = wall_lever(engine, batch, k, c.normal).norm();
  const HertzPrefactors prefactors = prefactors_of(
      batch, k, elasticity.on_plate(engine.particles().material[i]),
      1. / radius, 0.);
  set_springs(batch.layout.law, prefactors, radius, at.grown, at.overlap, c);
  c.closing_speed = at.closing_speed;
}

void add_planes(const Engine &engine, const Foresight &ahead,
                SpringNetwork &network)
{
  const ParticleSystem &particles = engine.particles();
  const ContactBatch &batch = on_planes(engine);
  const EngineParameters &parameters = engine.parameters();
  for (std::size_t k = 0; k < batch.size(); ++k)
  {
    const auto i = static_cast<std::size_t>(batch.a[k]);
    const Plane &plane = planes(engine)[static_cast<std::size_t>(batch.b[k])];
    if (!plane.is_active)
      continue;
    const Vec3 lever = wall_lever(engine, batch, k, -plane.normal);
    const double depth =
        (plane.point - particles.position(i) - lever).dot(plane.normal);
    const double gap = overlap_offset_of(batch, k) - depth;
    const Vec3 velocity = plane.velocity - particles.velocity(i);
    const double closing = ahead.horizon * velocity.norm();
    if (gap >= closing)
      continue;
    SpringContact c = wall_contact(
        parameters.wall, lever_at_wall(batch, lever, depth, -plane.normal),
        -plane.normal);
    set_wall_springs(engine, batch, k,
                     {-gap, closing - gap, velocity.dot(plane.normal)}, c);
    c.a = batch.a[k];
    c.reduced_mass = particles.mass(i);
    append(network, c, ahead);
  }
}

void add_drum(const Engine &engine, const Foresight &ahead,
              SpringNetwork &network)
{
  const ParticleSystem &particles = engine.particles();
  const ContactBatch &batch = on_drum(engine);
  const EngineParameters &parameters = engine.parameters();
  for (std::size_t k = 0; k < batch.size(); ++k)
  {
    const auto i = static_cast<std::size_t>(batch.a[k]);
    const DrumPart part = drum_part(batch, k);
    DrumPoint at = nearest_on_drum(drum(engine), part, particles.position(i));
    const Vec3 lever = wall_lever(engine, batch, k, at.normal);
    double reach = lever.dot(at.normal);
    if (batch.layout.has_contact_points)
    {
      at = nearest_on_drum(drum(engine), part, particles.position(i) + lever);
      reach = 0.;
    }
    const Vec3 velocity =
        drum(engine).velocity_at(part, at.point) - particles.velocity(i);
    const double depth = reach - at.distance;
    const double overlap = depth - overlap_offset_of(batch, k),
                 grown = overlap + ahead.horizon * velocity.norm();
    if (grown <= 0.)
      continue;
    SpringContact c =
        wall_contact(parameters.wall,
                     lever_at_wall(batch, lever, depth, at.normal), at.normal);
    set_wall_springs(engine, batch, k,
                     {overlap, grown, -velocity.dot(at.normal)}, c);
    c.a = batch.a[k];
    c.reduced_mass = particles.mass(i);
    append(network, c, ahead);
  }
}

/// Speed at which a particle closes in on the facet that it touches [m/s].
double closing_speed(const Engine &engine, const FacetSurface &surface,
                     const FacetContactPoint &contact_point,
                     std::int32_t particle)
{
  const auto &corner =
      surface.triangles[static_cast<std::size_t>(contact_point.triangle)];
  Vec3 velocity =
      engine.particles().velocity(static_cast<std::size_t>(particle));
  for (std::size_t v = 0; v < 3; ++v)
    velocity -= contact_point.weight[v] *
                surface.velocity[static_cast<std::size_t>(corner[v])];
  return velocity.dot(contact_point.normal);
}

/// `first_point`: the body of vertex 0 in the network.
void add_facets(const Engine &engine, const FacetBoundary &facets,
                std::int32_t first_point, const Foresight &ahead,
                SpringNetwork &network)
{
  const ParticleSystem &particles = engine.particles();
  const ContactBatch &batch = facets.batch;
  const FacetSurface &surface = facets.surface;
  for (std::size_t k = 0; k < batch.size(); ++k)
  {
    const FacetContactPoint &contact_point = facets.contact_points.point[k];
    if (!batch.is_touching(k) || contact_point.triangle < 0)
      continue;
    const double depth = batch.overlap[k] + overlap_offset_of(batch, k) -
                         contact_point.shares.extra;
    const Vec3 lever =
        lever_at_wall(batch, wall_lever(engine, batch, k, contact_point.normal),
                      depth, contact_point.normal);
    SpringContact c =
        wall_contact(facets.material, lever, contact_point.normal);
    set_wall_springs(
        engine, batch, k,
        {batch.overlap[k], batch.overlap[k],
         closing_speed(engine, surface, contact_point, batch.a[k])},
        c);
    // Several facets: on the vertices of the nearest, no softer than they are.
    c.normal_stiffness *= static_cast<double>(contact_point.shares.walls);
    c.a = batch.a[k];
    double over_mass = 1. / particles.mass(static_cast<std::size_t>(c.a));
    const auto &corner =
        surface.triangles[static_cast<std::size_t>(contact_point.triangle)];
    std::size_t n_shares = 0;
    for (std::size_t v = 0; v < 3; ++v)
    {
      const double mass = surface.mass[static_cast<std::size_t>(corner[v])];
      if (std::isinf(mass) || contact_point.weight[v] == 0.)
        continue;
      c.b[n_shares++] = {first_point + corner[v], contact_point.weight[v]};
      over_mass += contact_point.weight[v] * contact_point.weight[v] / mass;
    }
    c.reduced_mass = 1. / over_mass;
    append(network, c, ahead);
  }
}

} // namespace

SpringNetwork contact_springs(const Engine &engine, double horizon)
{
  SpringNetwork network;
  const Foresight ahead = foresight_of(engine, horizon);
  const auto end_kind = [&network]
  { network.kind_ends.push_back(network.n_contacts()); };
  network.mass = engine.particles().column(&ParticleState::mass);
  for (std::size_t i = 0; i < engine.particles().size(); ++i)
    network.inertia.push_back(engine.particles().smallest_moment(i));
  network.id = engine.particles().id;
  for (const std::int64_t id : network.id)
    network.n_ids = std::max(network.n_ids, id + 1);
  add_pairs(engine, ahead, network);
  end_kind();
  add_planes(engine, ahead, network);
  end_kind();
  if (drum(engine).is_there())
    add_drum(engine, ahead, network);
  end_kind();
  const auto add_surface = [&](const FacetBoundary &facets)
  {
    const auto first_point = static_cast<std::int32_t>(network.mass.size());
    // The mass of a prescribed vertex is not used.
    for (const double mass : facets.surface.mass)
      network.mass.push_back(std::isinf(mass) ? 1. : mass);
    add_facets(engine, facets, first_point, ahead, network);
    end_kind();
  };
  // First those whose vertices may refer to other bodies, as the mesh of a
  // membrane does (coupling::refer_to_nodes): no wall may lie between them.
  for (const FacetBoundary &facets : surfaces(engine))
    add_surface(facets);
  for (const MeshWall &wall : mesh_walls(engine))
    add_surface(wall);
  if (horizon > 0.)
    add_impacts(engine, ahead, network);
  end_kind();
  return network;
}

double corner_step(const EngineParameters &parameters,
                   const ParticleSystem &particles)
{
  const LawChoice law = law_of(parameters.wall);
  if (law.entry().exponent > 1.)
    return std::numeric_limits<double>::infinity();
  const ParticleState &lightest =
      *std::min_element(particles.state.begin(), particles.state.end(),
                        [](const ParticleState &a, const ParticleState &b)
                        { return a.mass < b.mass; });
  SpringNetwork network;
  network.mass = {lightest.mass};
  network.inertia = {lightest.inertia};
  for (int d = 0; d < 3; ++d)
  {
    SpringContact c = wall_contact(
        parameters.wall, -lightest.radius * Vec3::Unit(d), -Vec3::Unit(d));
    set_springs(law, {}, 0., 1., 1., c);
    c.reduced_mass = lightest.mass;
    append(network, c, {});
  }
  return guaranteed_step(network).step;
}
} // namespace dem
