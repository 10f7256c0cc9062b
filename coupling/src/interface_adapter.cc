#include <coupling/interface_adapter.h>
#include <dem/engine_boundaries.h>

#include <cmath>

namespace coupling
{
namespace
{
using Vector = Eigen::Vector3d;

/// d F / d delta of a contact that touches, at most that of all facets that
/// carry it.
double tangent(const dem::FacetBoundary &facets, std::size_t k)
{
  return static_cast<double>(facets.contact_points.point[k].shares.walls) *
         facets.batch.normal_stiffness(k);
}

/// Every node that carries contact k, with its share of the load; what facets
/// share counts upwards, so that no node comes out softer than it is.
template <class Visit>
void for_each_share(const dem::FacetBoundary &facets, std::size_t k,
                    const InterfaceMap &map, const Visit &visit)
{
  dem::for_shares(facets.surface, facets.contact_points.point[k],
                  [&](const dem::VertexShare &vertex)
                  {
                    for (const dem::FarShare &share :
                         map.shares(static_cast<std::size_t>(vertex.vertex)))
                      if (share.body >= 0)
                        visit(static_cast<std::size_t>(share.body),
                              std::abs(vertex.weight) * share.weight);
                  });
}

/// A dashpot may hold the spring back, never pull: then the contact gives
/// nothing, and nothing changes with its motion.
bool presses(const dem::FacetBoundary &facets, std::size_t k)
{
  return facets.batch.load[k].force.dot(facets.contact_points.point[k].normal) <
         0.;
}

/// Springs of a contact along and across its normal, none across if it slides,
/// and the dashpot along it. That across fades as sliding begins: counted in
/// full it makes energy.
struct ContactSprings
{
  Eigen::Matrix3d spring, dashpot; ///< [N/m], [N s/m]
};

ContactSprings springs_of(const dem::FacetBoundary &facets, std::size_t k,
                          const dem::ParticleSystem &particles)
{
  const dem::ContactBatch &batch = facets.batch;
  const dem::WallMaterial &m = facets.material;
  const dem::FacetContactPoint &contact_point = facets.contact_points.point[k];
  const double particle = particles.mass(static_cast<std::size_t>(batch.a[k]));
  const double mass =
      1. / (1. / particle +
            dem::facet_row(facets.surface, contact_point, contact_point)
                .inverse_mass);
  const double shear =
      Vector(batch.shear.x[k], batch.shear.y[k], batch.shear.z[k]).norm();
  const bool slides = shear > 0.999 * m.friction * batch.normal_force[k];
  const double along = tangent(facets, k);
  const double across = slides || !(batch.shear_compliance[k] > 0.)
                            ? 0.
                            : 1. / batch.shear_compliance[k];
  const auto both = [&](double normal, double tangential) -> Eigen::Matrix3d
  {
    const Eigen::Matrix3d projector =
        contact_point.normal * contact_point.normal.transpose();
    return normal * projector +
           tangential * (Eigen::Matrix3d::Identity() - projector);
  };
  return {both(along, across),
          both(2. * m.normal_damping * std::sqrt(mass * along), 0.)};
}
} // namespace

void FacetAdapter::place(const NodeMotion &motion, dem::Engine &engine) const
{
  map.send_motion(motion, dem::surface(engine, number));
}

void FacetAdapter::collect(const dem::Engine &engine, Collected what,
                           std::span<Vector> nodal) const
{
  const dem::FacetBoundary &facets = dem::facet_boundary(engine, number);
  map.collect(what == Collected::load ? facets.surface.load : facets.impulse,
              nodal);
}

void FacetAdapter::forget_impulse(dem::Engine &engine) const
{
  for (Vector &impulse : dem::facet_boundary(engine, number).impulse)
    impulse = Vector::Zero();
}

InterfaceSums FacetAdapter::sums(const dem::Engine &engine) const
{
  const dem::FacetBoundary &facets = dem::facet_boundary(engine, number);
  InterfaceSums sums;
  sums.work = -facets.work();
  for (const Vector &impulse : facets.impulse)
    sums.impulse += impulse;
  return sums;
}

void FacetAdapter::add_stiffness(const dem::Engine &engine,
                                 std::span<dem::ExactSum> nodal) const
{
  const dem::FacetBoundary &facets = dem::facet_boundary(engine, number);
  for (std::size_t k = 0; k < facets.batch.size(); ++k)
  {
    if (!facets.batch.is_touching(k))
      continue;
    const double stiffness = tangent(facets, k);
    for_each_share(facets, k, map,
                   [&](std::size_t node, double share)
                   { nodal[node].add(stiffness * share); });
  }
}

void FacetAdapter::add_tangent(const dem::Engine &engine,
                               ContactTangent &nodal) const
{
  const dem::FacetBoundary &facets = dem::facet_boundary(engine, number);
  for (std::size_t k = 0; k < facets.batch.size(); ++k)
  {
    if (!facets.batch.is_touching(k) || !presses(facets, k))
      continue;
    const ContactSprings contact = springs_of(facets, k, engine.particles());
    for_each_share(
        facets, k, map,
        [&](std::size_t node, double share)
        { nodal.add(node, share * contact.spring, share * contact.dashpot); });
  }
}

void PlaneAdapter::place(const NodeMotion &motion, dem::Engine &engine) const
{
  dem::planes(engine)[number].velocity = motion.velocity[0];
}

void PlaneAdapter::collect(const dem::Engine &engine, Collected what,
                           std::span<Vector> nodal) const
{
  const dem::Plane &plane = dem::planes(engine)[number];
  nodal[0] = what == Collected::load ? plane.force : plane.impulse;
}

void PlaneAdapter::forget_impulse(dem::Engine &engine) const
{
  dem::planes(engine)[number].impulse = Vector::Zero();
}

InterfaceSums PlaneAdapter::sums(const dem::Engine &engine) const
{
  const dem::Plane &plane = dem::planes(engine)[number];
  return {-plane.work, plane.impulse};
}

void PlaneAdapter::add_stiffness(const dem::Engine &engine,
                                 std::span<dem::ExactSum> nodal) const
{
  const dem::ContactBatch &batch = dem::on_planes(engine);
  for (std::size_t k = 0; k < batch.size(); ++k)
    if (batch.is_touching(k) && batch.b[k] == static_cast<std::int32_t>(number))
      nodal[0].add(batch.normal_stiffness(k));
}

void SplitAdapter::place(const NodeMotion &motion, dem::Engine &engine) const
{
  one->place({motion.position.first(n), motion.velocity.first(n)}, engine);
  other->place({motion.position.subspan(n), motion.velocity.subspan(n)},
               engine);
}

void SplitAdapter::collect(const dem::Engine &engine, Collected what,
                           std::span<Vector> nodal) const
{
  one->collect(engine, what, nodal.first(n));
  other->collect(engine, what, nodal.subspan(n));
}

void SplitAdapter::forget_impulse(dem::Engine &engine) const
{
  one->forget_impulse(engine);
  other->forget_impulse(engine);
}

/// The other boundary is that of a body that does not take it.
void SplitAdapter::add_tangent(const dem::Engine &engine,
                               ContactTangent &nodal) const
{
  one->add_tangent(engine, nodal);
}

InterfaceSums SplitAdapter::sums(const dem::Engine &engine) const
{
  const InterfaceSums a = one->sums(engine), b = other->sums(engine);
  return {a.work + b.work, a.impulse + b.impulse};
}

void SplitAdapter::add_stiffness(const dem::Engine &engine,
                                 std::span<dem::ExactSum> nodal) const
{
  one->add_stiffness(engine, nodal.first(n));
  other->add_stiffness(engine, nodal.subspan(n));
}
} // namespace coupling
