#include <dem/search/candidates.h>
#include <dem/search/cell_grid.h>

#include <algorithm>
#include <map>

namespace dem
{
namespace
{
using Key = std::pair<std::int32_t, std::int32_t>;

double largest_reach(const Particles &particles)
{
  double largest = 0.;
  for (const Body &body : particles.body)
    largest = std::max(largest, body.circumscribed_radius);
  return largest;
}

/// Partners of stone i with a higher number whose circumscribed sphere comes
/// within the margin.
void find_partners(const Particles &particles, const CellGrid &grid,
                   std::size_t i, double range, double margin,
                   std::vector<std::int32_t> &partners)
{
  partners.clear();
  const Vec3 &x = particles.position[i];
  const double own = particles.body[i].circumscribed_radius;
  const Vec3 box = Vec3::Constant(own + range);
  grid.visit_box(x - box, x + box,
                 [&](std::int32_t other)
                 {
                   const auto j = static_cast<std::size_t>(other);
                   if (j <= i)
                     return;
                   const double reach =
                       own + particles.body[j].circumscribed_radius + margin;
                   if ((particles.position[j] - x).squaredNorm() <
                       reach * reach)
                     partners.push_back(other);
                 });
  std::sort(partners.begin(), partners.end());
}

/// Puts the batch in the order of `keys` (sorted, as the old one is).
void carry_over(const std::vector<Key> &keys, ContactBatch &batch,
                Dissipation &retired)
{
  ContactBatch fresh;
  fresh.resize(keys.size());
  std::size_t old = 0;
  const auto retire = [&]
  {
    open_contact(batch.history[old], Vec3::Zero(), batch.lost[old]);
    retired += batch.lost[old];
    ++old;
  };
  for (std::size_t k = 0; k < keys.size(); ++k)
  {
    while (old < batch.size() && Key(batch.a[old], batch.b[old]) < keys[k])
      retire();
    if (old < batch.size() && Key(batch.a[old], batch.b[old]) == keys[k])
      fresh.copy_entry(k, batch, old++);
    fresh.a[k] = keys[k].first;
    fresh.b[k] = keys[k].second;
  }
  while (old < batch.size())
    retire();
  batch = std::move(fresh);
}

/// Triangles filed under the cells of a coarse grid that their boxes touch.
class TriangleBins
{
public:
  TriangleBins(const FacetSurface &surface, double cell_size) : size(cell_size)
  {
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    {
      Vec3 lower, upper;
      box_of(surface, t, lower, upper);
      visit(lower, upper,
            [&](const std::array<std::int64_t, 3> &cell)
            { bins[cell].push_back(static_cast<std::int32_t>(t)); });
    }
  }

  /// Triangles that may lie in the box, each once, in order.
  void gather(const Vec3 &lower, const Vec3 &upper,
              std::vector<std::int32_t> &found) const
  {
    found.clear();
    visit(lower, upper,
          [&](const std::array<std::int64_t, 3> &cell)
          {
            if (const auto bin = bins.find(cell); bin != bins.end())
              found.insert(found.end(), bin->second.begin(), bin->second.end());
          });
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
  }

private:
  static void box_of(const FacetSurface &surface, std::size_t t, Vec3 &lower,
                     Vec3 &upper)
  {
    const auto &corner = surface.triangles[t];
    lower = upper = surface.position[static_cast<std::size_t>(corner[0])];
    for (std::size_t c = 1; c < 3; ++c)
    {
      const Vec3 &x = surface.position[static_cast<std::size_t>(corner[c])];
      lower = lower.cwiseMin(x);
      upper = upper.cwiseMax(x);
    }
  }

  template <class Visit>
  void visit(const Vec3 &lower, const Vec3 &upper, const Visit &call) const
  {
    const auto cell = [this](double x)
    { return static_cast<std::int64_t>(std::floor(x / size)); };
    for (std::int64_t z = cell(lower.z()); z <= cell(upper.z()); ++z)
      for (std::int64_t y = cell(lower.y()); y <= cell(upper.y()); ++y)
        for (std::int64_t x = cell(lower.x()); x <= cell(upper.x()); ++x)
          call(std::array<std::int64_t, 3>{x, y, z});
  }

  double size;
  std::map<std::array<std::int64_t, 3>, std::vector<std::int32_t>> bins;
};

/// Slots of the stones that stay near go with them, the others retire.
void carry_over_slots(const FacetCandidates &before,
                      const FacetCandidates &after, ContactBatch &batch,
                      std::vector<FacetSpot> &spot, Dissipation &retired)
{
  ContactBatch fresh;
  fresh.resize(after.stone.size() * slots_per_stone);
  std::size_t old = 0;
  const auto retire = [&]
  {
    for (std::size_t k = old * slots_per_stone; k < (old + 1) * slots_per_stone;
         ++k)
    {
      open_contact(batch.history[k], Vec3::Zero(), batch.lost[k]);
      retired += batch.lost[k];
    }
    ++old;
  };
  for (std::size_t r = 0; r < after.stone.size(); ++r)
  {
    while (old < before.stone.size() && before.stone[old] < after.stone[r])
      retire();
    const bool is_kept =
        old < before.stone.size() && before.stone[old] == after.stone[r];
    for (std::size_t s = 0; s < slots_per_stone; ++s)
    {
      const std::size_t to = r * slots_per_stone + s;
      if (is_kept)
      {
        fresh.copy_entry(to, batch, old * slots_per_stone + s);
        spot[to] = before.spot[old * slots_per_stone + s];
      }
      fresh.a[to] = after.stone[r];
      fresh.b[to] = static_cast<std::int32_t>(s);
    }
    old += is_kept ? 1 : 0;
  }
  while (old < before.stone.size())
    retire();
  batch = std::move(fresh);
}
} // namespace

void rebuild_pairs(const Particles &particles, double margin,
                   ContactBatch &batch, Dissipation &retired)
{
  const double largest = largest_reach(particles);
  const CellGrid grid(particles.position, largest);
  const auto n = static_cast<std::int64_t>(particles.size());
  std::vector<std::vector<std::int32_t>> partners(particles.size());
#pragma omp parallel for schedule(dynamic, 32)
  for (std::int64_t i = 0; i < n; ++i)
    find_partners(particles, grid, static_cast<std::size_t>(i),
                  largest + margin, margin,
                  partners[static_cast<std::size_t>(i)]);
  std::vector<Key> keys;
  for (std::size_t i = 0; i < partners.size(); ++i)
    for (const std::int32_t j : partners[i])
      keys.emplace_back(static_cast<std::int32_t>(i), j);
  carry_over(keys, batch, retired);
}

void rebuild_planes(const Particles &particles,
                    const std::vector<Plane> &planes, const WallSearch &search,
                    ContactBatch &batch, Dissipation &retired)
{
  std::vector<Key> keys;
  for (std::size_t i = 0; i < particles.size(); ++i)
    for (std::size_t p = 0; p < planes.size(); ++p)
      if (planes[p].is_active &&
          (particles.position[i] - planes[p].point).dot(planes[p].normal) <
              wall_bound(particles, i, search.geometry) + search.margin)
        keys.emplace_back(static_cast<std::int32_t>(i),
                          static_cast<std::int32_t>(p));
  carry_over(keys, batch, retired);
}

void rebuild_facets(const Particles &particles, const FacetSurface &surface,
                    const WallSearch &search, FacetCandidates &candidates,
                    ContactBatch &batch, Dissipation &retired)
{
  const TriangleBins bins(surface, 2. * largest_reach(particles));
  FacetCandidates fresh;
  fresh.row_start.push_back(0);
  std::vector<std::int32_t> found;
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    const Vec3 &x = particles.position[i];
    const double reach =
        1.25 * wall_bound(particles, i, search.geometry) + search.margin;
    bins.gather(x - Vec3::Constant(reach), x + Vec3::Constant(reach), found);
    const std::size_t before = fresh.triangle.size();
    for (const std::int32_t t : found)
    {
      const auto &corner = surface.triangles[static_cast<std::size_t>(t)];
      const NearestPoint nearest = nearest_point(
          x, {surface.position[static_cast<std::size_t>(corner[0])],
              surface.position[static_cast<std::size_t>(corner[1])],
              surface.position[static_cast<std::size_t>(corner[2])]});
      if ((nearest.point - x).squaredNorm() < reach * reach)
        fresh.triangle.push_back(t);
    }
    if (fresh.triangle.size() == before)
      continue;
    fresh.stone.push_back(static_cast<std::int32_t>(i));
    fresh.row_start.push_back(static_cast<std::int32_t>(fresh.triangle.size()));
  }
  fresh.spot.resize(fresh.stone.size() * slots_per_stone);
  fresh.wake.assign(fresh.stone.size(), 0.);
  carry_over_slots(candidates, fresh, batch, fresh.spot, retired);
  candidates = std::move(fresh);
}

double steepness(const Particles &particles)
{
  double largest = 0.;
  for (const Body &body : particles.body)
    largest = std::max(largest, body.max_slope / body.inscribed_radius);
  return largest;
}

double closing_speed(const Particles &particles, std::size_t k,
                     double steepness)
{
  const Body &body = particles.body[k];
  return (1. + steepness) * particles.velocity[k].norm() +
         std::max(body.max_slope,
                  body.series ? body.circumscribed_radius : 0.) *
             particles.spin[k].norm();
}
} // namespace dem
