#include <coupling/seam.h>

namespace coupling
{
namespace
{
using Vector = Eigen::Vector3d;

/// d F / d delta of a contact that touches: the springs are k or ~ delta^(3/2).
double tangent(const dem::ContactBatch &batch, std::size_t k,
               const dem::WallMaterial &material)
{
  return batch.layout.is_hertz ? 1.5 * batch.normal_force[k] / batch.overlap[k]
                               : material.normal_stiffness;
}
} // namespace

void FacetSeam::place(const NodeMotion &motion, dem::Engine &engine) const
{
  map.send_motion(motion, engine.surface(number));
}

void FacetSeam::collect(const dem::Engine &engine, Collected what,
                        std::span<Vector> nodal) const
{
  const dem::SurfaceContacts &facets = engine.surfaces()[number];
  map.collect(what == Collected::load ? facets.surface.load : facets.impulse,
              nodal);
}

void FacetSeam::forget_impulse(dem::Engine &engine) const
{
  for (Vector &impulse : engine.surfaces()[number].impulse)
    impulse = Vector::Zero();
}

SeamSums FacetSeam::sums(const dem::Engine &engine) const
{
  const dem::SurfaceContacts &facets = engine.surfaces()[number];
  SeamSums sums;
  sums.work = -facets.work;
  for (const Vector &impulse : facets.impulse)
    sums.impulse += impulse;
  return sums;
}

void FacetSeam::add_stiffness(const dem::Engine &engine,
                              std::span<double> nodal) const
{
  const dem::SurfaceContacts &facets = engine.surfaces()[number];
  for (std::size_t k = 0; k < facets.batch.size(); ++k)
  {
    if (!facets.batch.is_touching(k))
      continue;
    const double stiffness = tangent(facets.batch, k, facets.material);
    const dem::FacetSpot &spot = facets.candidates.spot[k];
    const auto &corner =
        facets.surface.triangles[static_cast<std::size_t>(spot.triangle)];
    for (std::size_t c = 0; c < 3; ++c)
      for (const dem::FarShare &share :
           map.shares(static_cast<std::size_t>(corner[c])))
        if (share.body >= 0)
          nodal[static_cast<std::size_t>(share.body)] +=
              stiffness * spot.weight[c] * share.weight;
  }
}

void PlaneSeam::place(const NodeMotion &motion, dem::Engine &engine) const
{
  engine.planes()[number].velocity = motion.velocity[0];
}

void PlaneSeam::collect(const dem::Engine &engine, Collected what,
                        std::span<Vector> nodal) const
{
  const dem::Plane &plane = engine.planes()[number];
  nodal[0] = what == Collected::load ? plane.force : plane.impulse;
}

void PlaneSeam::forget_impulse(dem::Engine &engine) const
{
  engine.planes()[number].impulse = Vector::Zero();
}

SeamSums PlaneSeam::sums(const dem::Engine &engine) const
{
  const dem::Plane &plane = engine.planes()[number];
  return {-plane.work, plane.impulse};
}

void PlaneSeam::add_stiffness(const dem::Engine &engine,
                              std::span<double> nodal) const
{
  const dem::ContactBatch &batch = engine.on_planes();
  for (std::size_t k = 0; k < batch.size(); ++k)
    if (batch.is_touching(k) && batch.b[k] == static_cast<std::int32_t>(number))
      nodal[0] += tangent(batch, k, engine.parameters().wall);
}

void SplitSeam::place(const NodeMotion &motion, dem::Engine &engine) const
{
  one->place({motion.position.first(n), motion.velocity.first(n)}, engine);
  other->place({motion.position.subspan(n), motion.velocity.subspan(n)},
               engine);
}

void SplitSeam::collect(const dem::Engine &engine, Collected what,
                        std::span<Vector> nodal) const
{
  one->collect(engine, what, nodal.first(n));
  other->collect(engine, what, nodal.subspan(n));
}

void SplitSeam::forget_impulse(dem::Engine &engine) const
{
  one->forget_impulse(engine);
  other->forget_impulse(engine);
}

SeamSums SplitSeam::sums(const dem::Engine &engine) const
{
  const SeamSums a = one->sums(engine), b = other->sums(engine);
  return {a.work + b.work, a.impulse + b.impulse};
}

void SplitSeam::add_stiffness(const dem::Engine &engine,
                              std::span<double> nodal) const
{
  one->add_stiffness(engine, nodal.first(n));
  other->add_stiffness(engine, nodal.subspan(n));
}
} // namespace coupling
