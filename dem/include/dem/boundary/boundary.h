#pragma once

#include <dem/contact/forces.h>
#include <dem/contact/lost_energy.h>
#include <dem/neighbor/contact_point_lists.h>

#include <functional>
#include <iosfwd>
#include <limits>
#include <memory>
#include <string>

namespace dem
{
/// What the list of contacts with a boundary is made from, and what it adds to.
struct BoundarySearch
{
  ContactPointSearchInput points; ///< of true surfaces; layout of no boundary
  /// Whether it is so on any rank: all ranks search at the same time.
  std::function<bool(bool)> is_on_any_rank;
  double least_radius = 0.; ///< of the equivalent spheres of all ranks [m]
  double skin = 0.;         ///< how far beyond contact lists look [m]
  double rigid_path = 0.;   ///< by the fastest rigid boundary [m]
  double &deforming_left;   ///< skin left of boundaries that deform [m]
  LostEnergy &retired;      ///< takes what dropped springs held
  ContactPointEvents &events;
};

/// Sums over the contacts of a boundary that do not depend on the order of
/// their terms, nor on the ranks that have them.
struct BoundarySums
{
  std::span<ExactSum> exact = {};
  /// Sums of multiples of a spacing that all ranks choose alike: for many sums.
  std::span<std::int64_t> counts = {};
};

/// What particles meet besides each other. The engine holds any number of them
/// and calls each function once per step or list; nothing here is called per
/// contact. How to add a kind: docs/developer/extending.md.
class Boundary
{
public:
  explicit Boundary(const WallMaterial &of) : material(of) {}
  virtual ~Boundary() = default;
  Boundary &operator=(const Boundary &) = delete;
  /// Through pack() and unpack(), unless a kind has a shorter way.
  virtual std::unique_ptr<Boundary> copy() const;

  /// Name of the kind, in checkpoints and ledgers.
  virtual std::string kind() const = 0;
  /// Contact k in messages: "the drum".
  virtual std::string name_of(std::size_t k) const = 0;
  /// Order in which the engine evaluates the kinds, lower first: planes 0, drum
  /// 1, facet surfaces 2, other kinds 3 unless they choose another. Boundaries
  /// of the same order keep the sequence in which they were added.
  virtual int evaluation_order() const { return 3; }
  /// BreakageEvent::kind and other of contact k.
  virtual int event_kind() const = 0;
  virtual std::int64_t event_other(std::size_t) const { return -1; }

  /// It deforms, and has a list of its own where particles follow their
  /// surfaces.
  virtual bool deforms() const { return false; }
  /// Moves by one step; books half of its work, with the old forces.
  virtual void move(double time_step) = 0;
  /// The fastest point that may come nearer to a particle [m/s].
  virtual double speed() const = 0;
  /// How far a point is beyond it [m]; < 0: inside.
  virtual double beyond(const Vec3 &) const
  {
    return -std::numeric_limits<double>::infinity();
  }

  /// Makes the list of contacts; known ones keep what they carry.
  virtual void find_candidates(const BoundarySearch &search) = 0;
  /// Whether its contacts can be spread over ranks: with the functions
  /// below all that it stores of contacts goes with them, and sum_loads() is
  /// all that ranks must sum.
  virtual bool can_be_shared() const { return false; }
  /// Pairs of particles and itself that may touch; null: it stores none.
  virtual std::vector<CandidatePair> *candidates() { return nullptr; }
  /// What it stores of single particles besides follows them to other rows:
  /// new_row[old] = new, -1: they are gone.
  virtual void keep_particles(const std::vector<std::int32_t> &) {}
  /// Writes what it stores of these rows; a boundary of the same kind adds it,
  /// for particles from row `first` on.
  virtual void pack_particles(std::ostream &,
                              const std::vector<std::int32_t> &) const
  {
  }
  virtual void unpack_particles(std::istream &, std::size_t) {}
  /// Contact k becomes contact order[k]; others are gone.
  virtual void keep_contacts(const std::vector<std::int32_t> &order);
  /// Sorts the contacts by particle, part of the boundary, and where they are
  /// on the particle; returns which contact each one was.
  virtual std::vector<std::int32_t> sort_contacts();
  /// Writes what it stores of these contacts besides `batch`; a boundary of the
  /// same kind, whose batch has got them at its end, reads it.
  virtual void pack_contacts(std::ostream &,
                             const std::vector<std::int32_t> &) const
  {
  }
  virtual void unpack_contacts(std::istream &) {}
  /// Swaps all contacts with a boundary of the same kind.
  virtual void swap_contacts(Boundary &other);
  /// Contact k becomes contact l of the other one, with its own particle.
  virtual void take_contact(std::size_t k, const Boundary &other,
                            std::size_t l);
  /// Work of a touching contact over that of two spheres [-].
  virtual double contact_cost() const { return 1.; }

  /// Finds where the particles meet it now.
  virtual ForceSum meet(const ForceContext &context) = 0;
  /// The boundary as its contacts meet it, for the loop over them.
  virtual Walls walls(const ForceContext &context) = 0;
  /// Sums over the contacts of this rank, which the engine makes sums over all
  /// ranks before apply_loads().
  virtual BoundarySums sum_loads(const SumGrid &) { return {}; }
  /// Takes the loads of the contacts; books the other half of the work.
  virtual void apply_loads(double time_step) = 0;
  /// Done on the particles [J].
  virtual double work() const = 0;
  /// Part of contact k in what contacts store together beyond the energies of
  /// their springs [J].
  virtual double energy_beyond_springs(std::size_t) const { return 0.; }

  /// The particles have got other numbers: new_row[old] = new.
  void renumber(const std::vector<std::int32_t> &new_row);

  /// Full state, bit for bit; unpack() on a new one of the kind.
  void pack(std::ostream &out) const;
  void unpack(std::istream &in); ///< throws std::runtime_error

  WallMaterial material; ///< particles on it
  ContactBatch batch;    ///< `b` is the row in walls()
  /// Dissipated by sliding on it so far; of the contacts of this rank, and of
  /// all in Engine::gathered() [J].
  ExactSum friction;

protected:
  Boundary(const Boundary &) = default;

private:
  virtual void pack_parts(std::ostream &out) const = 0;
  virtual void unpack_parts(std::istream &in) = 0;
};

/// Whether particles meet boundaries with their true surfaces.
bool follows_surfaces(const ForceContext &context);

/// Adds a kind that checkpoints may name. Throws std::invalid_argument if the
/// name is taken.
void add_boundary_kind(const std::string &kind,
                       std::function<std::unique_ptr<Boundary>()> make);

/// A new boundary of a kind; throws std::runtime_error on a name that is none.
std::unique_ptr<Boundary> make_boundary(const std::string &kind);
} // namespace dem
