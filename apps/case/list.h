#pragma once

#include "case/case.h"
#include "case/parameter.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace spall
{
/// What a line of the list says besides its field and range.
struct Text
{
  std::string key, unit, sentence, reason = "";
  std::vector<std::string> old_keys = {};
};

/// Collects the lines of one section after the other.
class List
{
public:
  /// `only` the cases of these kinds have the keys that follow; empty: all.
  void in(const std::string &name, const std::vector<CaseKind> &only = {})
  {
    section = name;
    kinds = only;
  }
  void add(const Text &text, double &field, const Range &range)
  {
    put(text, &field, range);
  }
  void add(const Text &text, int &field, const Range &range)
  {
    put(text, &field, range);
  }
  void add(const Text &text, bool &field) { put(text, &field, {}); }
  void add(const Text &text, std::string &field) { put(text, &field, {}); }
  void add_path(const Text &text, std::string &field)
  {
    put(text, &field, {});
    parameters.back().is_path = true;
  }
  /// `names` in the order of the enumeration.
  template <class Enum>
  void add(const Text &text, Enum &field, const std::vector<std::string> &names,
           const std::map<std::string, std::string> &old_names = {})
  {
    Choice choice{names, old_names,
                  [&field] { return static_cast<std::size_t>(field); },
                  [&field](std::size_t k) { field = static_cast<Enum>(k); }};
    put(text, std::move(choice), {});
  }

  /// One of these names.
  void add_name(const Text &text, std::string &field,
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
    put(text, std::move(choice), {});
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
  void put(const Text &text, decltype(Parameter::value) value,
           const Range &range)
  {
    parameters.push_back({section, text.key, text.unit, text.sentence,
                          std::move(value), range, text.reason, text.old_keys,
                          kinds});
  }

  std::string section;
  std::vector<CaseKind> kinds;
};

void add_specimen(List &list, SpecimenParameters &s);
void add_preparation(List &list, PreparationParameters &p);
void add_membrane(List &list, fem::MembraneParameters &m);
void add_coupling(List &list, CouplingParameters &c);
void add_contact(List &list, Case &of);
/// The choice of a contact law by its name.
void add_law(List &list, const Text &text, std::string &name);
/// The parameters of all contact laws that the section has no key for yet.
void add_law_values(List &list, std::vector<dem::LawValues> &values);
/// Of the section the list is in; `rolling` is the range of rolling_friction.
void add_wall(List &list, dem::WallMaterial &w, const Range &rolling,
              const std::string &reason);
void add_subgrade(List &list, SubgradeParameters &s);
/// What differs from the defaults of a Case.
void set_subgrade_defaults(Case &c);
/// Particle, Press, Charge and Drum.
void add_laboratory(List &list, Case &of);
/// Container, Filling, Plate and Vibration.
void add_compaction(List &list, Case &of);
} // namespace spall
