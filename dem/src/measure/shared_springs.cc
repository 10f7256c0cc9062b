// Springs of contacts that are spread over ranks.
#include <dem/binary.h>
#include <dem/measure/contact_springs.h>
#include <dem/parallel/distribution.h>
#include <dem/parallel/rank_sums.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <sstream>
#include <tuple>
#include <unordered_map>

namespace dem
{
namespace
{
/// A contact on its way to another rank. Bodies have their names.
struct SentContact
{
  std::int64_t kind = 0;
  std::int64_t a = 0;
  std::array<std::int64_t, 4> b{-1, -1, -1, -1};
  std::array<double, 4> weight{};
  double mass_a = 0., inertia_a = 0.; ///< [kg], [kg m^2]
  double mass_b = 0., inertia_b = 0.; ///< of a particle b[0]
  Vec3 normal, lever_a, lever_b;
  double normal_stiffness = 0., shear_stiffness = 0., rolling_stiffness = 0.;
  double normal_dashpot = 0., shear_dashpot = 0.;
};

/// Calls visit(column) for the columns of contacts.
template <class Visit>
void visit_contacts(SpringNetwork &network, const Visit &visit)
{
  visit(network.a);
  visit(network.b);
  visit(network.normal);
  visit(network.lever_a);
  visit(network.lever_b);
  visit(network.normal_stiffness);
  visit(network.shear_stiffness);
  visit(network.rolling_stiffness);
  visit(network.normal_dashpot);
  visit(network.shear_dashpot);
}

std::size_t index(std::int32_t body)
{
  return static_cast<std::size_t>(body);
}

/// Bytes for other ranks, and what has come from them.
template <class Item>
std::vector<std::pair<int, std::vector<Item>>>
deliver(const Ranks &ranks, const std::map<int, std::vector<Item>> &items)
{
  std::vector<Parcel> parcels;
  for (const auto &[rank, own] : items)
  {
    std::ostringstream out;
    write_column(out, own);
    const std::string text = out.str();
    const auto bytes = std::as_bytes(std::span(text));
    parcels.push_back({rank, {bytes.begin(), bytes.end()}});
  }
  std::vector<std::pair<int, std::vector<Item>>> arrived;
  for (const Parcel &parcel : ranks.deliver(std::move(parcels)))
  {
    std::istringstream in(
        std::string(reinterpret_cast<const char *>(parcel.content.data()),
                    parcel.content.size()));
    arrived.emplace_back(parcel.rank, std::vector<Item>());
    read_column(in, arrived.back().second);
  }
  return arrived;
}

/// Bodies by name, with the ranks that own them.
class BodiesOfRanks final : public SharedBodies
{
public:
  /// `names`: of the bodies of this rank, each owned by owners[body].
  /// Collective.
  BodiesOfRanks(const Ranks &all, const std::vector<std::int64_t> &names,
                const std::vector<int> &owners)
      : ranks(all), owner(owners)
  {
    std::unordered_map<std::int64_t, std::size_t> body_of;
    std::map<int, std::vector<std::int64_t>> wanted;
    for (std::size_t body = 0; body < names.size(); ++body)
      if (is_owned(body))
        body_of[names[body]] = body;
      else
      {
        wanted[owner[body]].push_back(names[body]);
        received_by[owner[body]].push_back(body);
      }
    std::vector<int> destination;
    for (const auto &[rank, asked] : deliver(ranks, wanted))
      for (const std::int64_t name : asked)
      {
        sent.push_back(body_of.at(name));
        destination.push_back(rank);
      }
    plan = ranks.plan(destination);
  }

  bool is_owned(std::size_t body) const override
  {
    return owner[body] == ranks.rank();
  }

  void fill(std::span<double> values) const override
  {
    const std::size_t n = values.size() / owner.size();
    std::vector<double> out, in(n * plan->n_received());
    for (const std::size_t body : sent)
      for (std::size_t q = 0; q < n; ++q)
        out.push_back(values[n * body + q]);
    plan->forward(out.data(), n * sizeof(double), in.data());
    // By the rank of the sender, then in the order in which they were asked.
    std::size_t item = 0;
    for (const auto &[rank, bodies] : received_by)
      for (const std::size_t body : bodies)
      {
        for (std::size_t q = 0; q < n; ++q)
          values[n * body + q] = in[n * item + q];
        ++item;
      }
  }

  void largest(std::span<double> values) const override { ranks.max(values); }
  void sum(std::span<ExactSum> sums) const override
  {
    sum_over_ranks(ranks, sums);
  }

private:
  const Ranks &ranks;
  std::vector<int> owner;        ///< by body
  std::vector<std::size_t> sent; ///< bodies, by item
  std::map<int, std::vector<std::size_t>> received_by;
  std::unique_ptr<ExchangePlan> plan;
};

/// The ranks that own the particles of the rows of this one.
std::vector<int> owners_of_rows(const Engine &engine)
{
  const ParticleSystem &particles = engine.particles();
  const int own = engine.distribution().ranks().rank();
  std::vector<Vec3> rank(particles.size(), Vec3(own, 0., 0.));
  engine.distribution().exchange().fill(rank);
  std::vector<int> owners;
  for (const Vec3 &of_row : rank)
    owners.push_back(static_cast<int>(of_row.x()));
  return owners;
}

/// Makes the network of a rank that of the bodies that it owns.
class Sharing
{
public:
  Sharing(const Engine &engine, SpringNetwork &springs)
      : ranks(engine.distribution().ranks()), network(springs),
        owner(owners_of_rows(engine)), kind(springs.n_contacts())
  {
    std::size_t k = 0;
    for (std::size_t which = 0; which < network.kind_ends.size(); ++which)
      for (; k < network.kind_ends[which]; ++k)
        kind[k] = static_cast<std::int64_t>(which);
    std::array above{static_cast<double>(network.n_ids)};
    ranks.max(above);
    network.n_ids = static_cast<std::int64_t>(above[0]);
  }

  void share()
  {
    if (ranks.size() > 1)
      exchange_contacts();
    sort();
    share_impact();
    if (ranks.size() == 1)
      return;
    std::vector<std::int64_t> names;
    std::vector<int> owners;
    for (std::size_t body = 0; body < network.n_bodies(); ++body)
    {
      names.push_back(network.name_of(body));
      owners.push_back(owner_of(body));
    }
    network.sharing = std::make_shared<BodiesOfRanks>(ranks, names, owners);
  }

private:
  int owner_of(std::size_t body) const
  {
    return body < network.n_particles()
               ? owner[body]
               : static_cast<int>((body - network.n_particles()) %
                                  static_cast<std::size_t>(ranks.size()));
  }

  SentContact sent(std::size_t k) const
  {
    SentContact contact;
    contact.kind = kind[k];
    const std::size_t a = index(network.a[k]);
    contact.a = network.name_of(a);
    contact.mass_a = network.mass[a];
    contact.inertia_a = network.inertia[a];
    for (std::size_t s = 0; s < 4; ++s)
      if (const FarShare &share = network.b[k][s]; share.body >= 0)
      {
        contact.b[s] = network.name_of(index(share.body));
        contact.weight[s] = share.weight;
      }
    if (const std::int32_t b = network.b[k][0].body;
        b >= 0 && index(b) < network.n_particles())
    {
      contact.mass_b = network.mass[index(b)];
      contact.inertia_b = network.inertia[index(b)];
    }
    contact.normal = network.normal[k];
    contact.lever_a = network.lever_a[k];
    contact.lever_b = network.lever_b[k];
    contact.normal_stiffness = network.normal_stiffness[k];
    contact.shear_stiffness = network.shear_stiffness[k];
    contact.rolling_stiffness = network.rolling_stiffness[k];
    contact.normal_dashpot = network.normal_dashpot[k];
    contact.shear_dashpot = network.shear_dashpot[k];
    return contact;
  }

  /// To the owners of its bodies.
  void exchange_contacts()
  {
    std::map<int, std::vector<SentContact>> leaving;
    for (std::size_t k = 0; k < network.n_contacts(); ++k)
    {
      std::vector<int> to;
      for (const FarShare &share : network.b[k])
        if (share.body >= 0)
          if (const int rank = owner_of(index(share.body));
              rank != ranks.rank() && std::ranges::count(to, rank) == 0)
            to.push_back(rank);
      for (const int rank : to)
        leaving[rank].push_back(sent(k));
    }
    const auto arrived = deliver(ranks, leaving);
    for (const auto &[rank, contacts] : arrived)
      for (const SentContact &contact : contacts)
        meet_particles(contact, rank);
    add_particles();
    for (const auto &[rank, contacts] : arrived)
      for (const SentContact &contact : contacts)
        append(contact);
  }

  struct NewBody
  {
    std::int64_t name = 0;
    int owner = 0;
    double mass = 0., inertia = 0.;
  };

  /// Notes the particles of a contact that this rank does not know.
  void meet_particles(const SentContact &contact, int rank)
  {
    if (row_of.empty())
      for (std::size_t i = 0; i < network.n_particles(); ++i)
        row_of[network.id[i]] = i;
    if (row_of.try_emplace(contact.a, row_of.size()).second)
      found.push_back({contact.a, rank, contact.mass_a, contact.inertia_a});
  }

  /// After the particles and before the points.
  void add_particles()
  {
    const std::size_t before = network.n_particles();
    std::vector<double> masses;
    for (const NewBody &body : found)
    {
      network.id.push_back(body.name);
      network.inertia.push_back(body.inertia);
      owner.push_back(body.owner);
      masses.push_back(body.mass);
    }
    network.mass.insert(network.mass.begin() +
                            static_cast<std::ptrdiff_t>(before),
                        masses.begin(), masses.end());
    for (auto &shares : network.b)
      for (FarShare &share : shares)
        if (share.body >= 0 && index(share.body) >= before)
          share.body += static_cast<std::int32_t>(found.size());
  }

  std::int32_t body_of(std::int64_t name) const
  {
    const std::int64_t first = network.first_point_name();
    return static_cast<std::int32_t>(
        name < first
            ? row_of.at(name)
            : network.n_particles() + static_cast<std::size_t>(name - first));
  }

  void append(const SentContact &contact)
  {
    kind.push_back(contact.kind);
    network.a.push_back(body_of(contact.a));
    std::array<FarShare, 4> shares;
    for (std::size_t s = 0; s < 4; ++s)
      if (contact.b[s] >= 0)
        shares[s] = {body_of(contact.b[s]), contact.weight[s]};
    network.b.push_back(shares);
    network.normal.push_back(contact.normal);
    network.lever_a.push_back(contact.lever_a);
    network.lever_b.push_back(contact.lever_b);
    network.normal_stiffness.push_back(contact.normal_stiffness);
    network.shear_stiffness.push_back(contact.shear_stiffness);
    network.rolling_stiffness.push_back(contact.rolling_stiffness);
    network.normal_dashpot.push_back(contact.normal_dashpot);
    network.shear_dashpot.push_back(contact.shear_dashpot);
  }

  /// By kind, particle A and particle B, and by where they are on A: the order
  /// of several contacts of one pair is not the same on all ranks.
  void sort()
  {
    const auto key = [this](std::size_t k)
    {
      const std::int32_t b = network.b[k][0].body;
      const bool is_pair = b >= 0 && index(b) < network.n_particles();
      const Vec3 &at = network.lever_a[k];
      return std::tuple(kind[k], network.name_of(index(network.a[k])),
                        is_pair ? network.name_of(index(b)) : -1, at.x(),
                        at.y(), at.z());
    };
    std::vector<std::size_t> order(network.n_contacts());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, key);
    visit_contacts(network,
                   [&order](auto &column)
                   {
                     auto sorted = column;
                     for (std::size_t k = 0; k < order.size(); ++k)
                       sorted[k] = column[order[k]];
                     column = std::move(sorted);
                   });
    network.kind_ends.clear(); // those of other ranks lie between
  }

  /// The shortest one of all ranks, and of equal ones the fastest.
  void share_impact()
  {
    ForeseenImpact &impact = network.impact;
    std::array largest{-impact.duration};
    ranks.max(largest);
    std::array speed{impact.duration == -largest[0] ? impact.speed : 0.};
    ranks.max(speed);
    impact.duration = -largest[0];
    impact.speed = speed[0];
  }

  const Ranks &ranks;
  SpringNetwork &network;
  std::vector<int> owner;                               ///< of the particles
  std::vector<std::int64_t> kind;                       ///< of the contacts
  std::unordered_map<std::int64_t, std::size_t> row_of; ///< by id
  std::vector<NewBody> found;
};
} // namespace

void share_springs(const Engine &engine, SpringNetwork &network)
{
  Sharing(engine, network).share();
}
} // namespace dem
