#include "hollow_sphere.h"

#include <dem/binary.h>
#include <dem/boundary/wall_list.h>

void HollowSphere::find_candidates(const dem::BoundarySearch &search)
{
  const dem::ForceContext &context = search.points.context;
  const dem::ParticleSystem &particles = context.particles;
  const dem::BatchLayout layout =
      dem::wall_layout(context.parameters, material, particles);
  std::vector<dem::PairKey> near;
  for (std::size_t i = 0; i < particles.size(); ++i)
    if (radius - particles.position(i).norm() <
        dem::wall_bound(particles, i,
                        context.parameters.geometry.wall_geometry) +
            search.skin + layout.law.range())
      near.emplace_back(static_cast<std::int32_t>(i),
                        static_cast<std::int32_t>(particles.id[i]));
  dem::rebuild_walls(particles, near, layout, batch, search.retired);
}

dem::ForceSum HollowSphere::meet(const dem::ForceContext &context)
{
  const dem::ParticleSystem &particles = context.particles;
  rows.resize(particles.size());
  for (std::size_t k = 0; k < batch.size(); ++k)
  {
    const dem::Vec3 outward =
        particles.position(static_cast<std::size_t>(batch.a[k])).normalized();
    dem::WallRow &row = rows[static_cast<std::size_t>(batch.b[k])];
    const dem::Vec3 before = batch.is_touching(k) ? row.normal : outward;
    row = {radius * outward,  outward, dem::Vec3::Zero(),
           dem::Vec3::Zero(), before,  0.};
  }
  return {};
}

void HollowSphere::apply_loads(double)
{
  force = dem::Vec3::Zero();
  for (std::size_t k = 0; k < batch.size(); ++k)
    force -= batch.load[k].force;
}

void HollowSphere::pack_parts(std::ostream &out) const
{
  dem::write_value(out, radius);
  dem::write_column(out, rows);
}

void HollowSphere::unpack_parts(std::istream &in)
{
  dem::read_value(in, radius);
  dem::read_column(in, rows);
}
