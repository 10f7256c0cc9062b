#pragma once

#include <dem/engine.h>

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <iosfwd>
#include <map>
#include <span>
#include <string>
#include <utility>

namespace spall
{
/// What a boundary of a test is.
enum class BoundaryKind
{
  plane,
  drum,
  surface ///< of a body that is coupled to the particles; its label is the name
};

/// A boundary that has columns of its own in history.csv, from the first row
/// on, whether it is there already or not.
struct NamedBoundary
{
  std::string name;
  BoundaryKind kind = BoundaryKind::plane;
  std::size_t number = 0; ///< of a plane
};

/// Mass that particles have lost to other particles and to each boundary.
class RemovedMass
{
public:
  /// Adds events of particles of this density [kg/m^3].
  void add(std::span<const dem::BreakageEvent> events, double density);
  /// By BreakageEvent::kind and other; -1 for other particles [kg].
  double on(int kind, std::int64_t other) const;
  /// Adds an entry for each, by name: removed_mass_kg of summary.json. Planes
  /// and drum without a name have their number.
  void summarise(const dem::Engine &engine,
                 std::span<const NamedBoundary> named,
                 nlohmann::ordered_json &summary) const;

  void save(std::ostream &out) const;
  void restore(std::istream &in); ///< throws std::runtime_error

private:
  std::map<std::pair<int, std::int64_t>, double> masses; ///< [kg]
};
} // namespace spall
