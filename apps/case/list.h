#pragma once

#include "case/case.h"
#include "case/parameter.h"

#include <dem/shape/spherical_harmonics.h>

#include <algorithm>
#include <string_view>
#include <utility>

namespace spall
{
/// Text of a line of the list besides its field and range.
struct Text
{
  std::string key, unit, sentence, reason = "";
  std::vector<std::string> old_keys = {};
};

/// Usual ranges in SI units: a value in g/cm^3, GPa, kPa or mm is outside.
inline constexpr Range usual_densities = between(100., 25e3); ///< [kg/m^3]
inline constexpr Range usual_moduli = between(1e4, 1e13);     ///< [Pa]
inline constexpr Range usual_stresses = between(500., 1e9);   ///< [Pa]
inline constexpr Range usual_lengths = between(1e-3, 30.);    ///< [m]
inline constexpr Range usual_corners = between(-30., 30.);    ///< [m]

/// Flags of the parameters of a section, see Parameter.
struct Flags
{
  bool decides_preparation = true, may_change = false;
};

/// Parameters that only matter after the preparation.
inline constexpr Flags after_preparation{.decides_preparation = false};

/// Collects the lines of one section after the other.
class List
{
public:
  /// The keys that follow belong to this section. Each flag can be changed on
  /// the parameter that add() returns.
  void in(const std::string &name, const Flags &usual = {})
  {
    section = name;
    flags = usual;
  }
  /// Only cases of this kind have the keys that follow; empty: all.
  void only_of(const std::string &name) { kind = name; }
  /// `usual`: see Parameter.
  Parameter &add(const Text &text, double &field, const Range &range,
                 const Range &usual = {})
  {
    return put(text, &field, range, usual);
  }
  Parameter &add(const Text &text, int &field, const Range &range)
  {
    return put(text, &field, range);
  }
  Parameter &add(const Text &text, bool &field)
  {
    return put(text, &field, {});
  }
  Parameter &add(const Text &text, std::string &field)
  {
    return put(text, &field, {});
  }
  /// Three components; `range` and `usual` are those of each.
  Parameter &add(const Text &text, dem::Vec3 &field, const Range &range = {},
                 const Range &usual = {})
  {
    return put(text, &field, range, usual);
  }
  Parameter &add_path(const Text &text, std::string &field)
  {
    Parameter &path = put(text, &field, {});
    path.is_path = true;
    return path;
  }
  /// `names` in the order of the enumeration.
  template <class Enum>
  Parameter &add(const Text &text, Enum &field,
                 const std::vector<std::string> &names,
                 const std::map<std::string, std::string> &old_names = {})
  {
    Choice choice{names, old_names,
                  [&field] { return static_cast<std::size_t>(field); },
                  [&field](std::size_t k) { field = static_cast<Enum>(k); }};
    return put(text, std::move(choice), {});
  }

  /// One of these names.
  Parameter &add_name(const Text &text, std::string &field,
                      const std::vector<std::string> &names)
  {
    Choice choice{names,
                  {},
                  [&field, names]
                  {
                    return static_cast<std::size_t>(
                        std::find(names.begin(), names.end(), field) -
                        names.begin());
                  },
                  [&field, names](std::size_t k) { field = names.at(k); }};
    return put(text, std::move(choice), {});
  }
  /// Whether the section the list is in has this key.
  bool has(std::string_view key) const
  {
    return std::any_of(parameters.begin(), parameters.end(),
                       [&](const Parameter &p)
                       { return p.section == section && p.key == key; });
  }

  std::vector<Parameter> parameters;

private:
  Parameter &put(const Text &text, decltype(Parameter::value) value,
                 const Range &range, const Range &usual = {})
  {
    return parameters.emplace_back(
        Parameter{.section = section,
                  .key = text.key,
                  .unit = text.unit,
                  .sentence = text.sentence,
                  .value = std::move(value),
                  .range = range,
                  .reason = text.reason,
                  .usual = usual,
                  .old_keys = text.old_keys,
                  .kind = kind,
                  .decides_preparation = flags.decides_preparation,
                  .may_change = flags.may_change});
  }

  std::string section, kind;
  Flags flags;
};

void add_membrane(List &list, fem::MembraneParameters &m);
/// The keys of particles that are drawn from a gradation, in the section the
/// list is in: gradation, shapes, order and seed of `drawn`.
template <class Drawn>
void add_drawn_particles(List &list, Drawn &drawn)
{
  list.add_path({"gradation", "-",
                 "Gradation of the particles: CSV file diameter_m,passing_1 "
                 "with the share of the mass that passes."},
                drawn.gradation);
  list.add_path(
      {"shapes", "-",
       "Folder of the shape files of the particles. Empty stands for spheres."},
      drawn.shapes);
  list.add({"order", "-",
            "Order N_s of the spherical-harmonic series. Higher terms of the "
            "files are omitted."},
           drawn.order, between(1, dem::max_order));
  list.add({"seed", "-",
            "Seed of the random sizes, shapes, positions and orientations of "
            "the particles."},
           drawn.seed, between(0, 2147483647));
}
/// The keys of placed particles, in the section the list is in: particles and
/// largest_overlap of `placed`. `otherwise`: what there is without them.
template <class Placed>
void add_placed_particles(List &list, Placed &placed,
                          const std::string &otherwise)
{
  list.add_path(
      {"particles", "-",
       "CSV or JSON file of placed particles, or the folder of a run, "
       "whose last state is taken. Each particle has x,y,z and radius "
       "or diameter. Optional columns are qw,qx,qy,qz (orientation), "
       "vx,vy,vz, wx,wy,wz, shape and material. Without a file " +
           otherwise},
      placed.particles);
  Parameter &largest =
      list.add({"largest_overlap", "-",
                "Largest allowed overlap of placed particles, over the radius "
                "of the smaller one."},
               placed.largest_overlap, between(0., 0.5));
  largest.decides_preparation = false;
  largest.may_change = true;
}
void add_walls(List &list, std::vector<WallSection> &walls);
void add_coupling(List &list, CouplingParameters &c);
void add_contact(List &list, Case &of);
/// The choice of a contact law by its name.
void add_law(List &list, const Text &text, std::string &name);
/// The parameters of all contact laws that the section has no key for yet.
void add_law_values(List &list, std::vector<dem::LawValues> &values);
/// Of the section the list is in; `rolling` is the range of rolling_friction.
void add_wall(List &list, dem::WallMaterial &w, const Range &rolling,
              const std::string &reason);
} // namespace spall
