#include "force_kernels.h"

#include <dem/contact/law_table.h>
#include <dem/contact/laws.h>
#include <dem/instruction_set.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace dem
{
namespace
{
/// Loops of the law of this number, of the instruction set in use.
template <std::size_t law>
const kernel::Loops &loops_of_law()
{
  const InstructionSet set = instruction_set();
  return set == InstructionSet::avx512 ? kernel::avx512::contact_kernels[law]
         : set == InstructionSet::avx2 ? kernel::avx2::contact_kernels[law]
                                       : kernel::baseline::contact_kernels[law];
}

/// Adds a law to the others, whose keys share a section of a case with its own.
void add_to(std::vector<ContactLaw> &laws, const ContactLaw &law)
{
  const auto refuse = [&law](const std::string &why)
  { throw std::invalid_argument("contact law " + law.name + ": " + why); };
  if (law.parameters.size() > max_law_parameters)
    refuse("has " + std::to_string(law.parameters.size()) +
           " parameters, at most " + std::to_string(max_law_parameters) +
           " are possible");
  for (const ContactLaw &other : laws)
  {
    if (other.name == law.name)
      throw std::invalid_argument("there is a contact law " + law.name);
    for (const LawParameter &mine : law.parameters)
      if (std::ranges::find(other.parameters, mine.key, &LawParameter::key) !=
          other.parameters.end())
        refuse("its key " + std::string(mine.key) + " belongs to the law " +
               other.name);
  }
  laws.push_back(law);
}

std::vector<ContactLaw> laws_of_library()
{
  std::vector<ContactLaw> laws;
  [&laws]<std::size_t... law>(std::index_sequence<law...>)
  {
    (add_to(laws, contact_law_entry<std::tuple_element_t<law, ContactLaws>>(
                      loops_of_law<law>)),
     ...);
  }
  (std::make_index_sequence<std::tuple_size_v<ContactLaws>>());
  return laws;
}

std::vector<ContactLaw> &table()
{
  static std::vector<ContactLaw> laws = laws_of_library();
  return laws;
}

auto find(std::string_view name)
{
  return std::ranges::find(table(), name,
                           [](const ContactLaw &law) -> std::string_view
                           { return law.name; });
}
} // namespace

const std::vector<ContactLaw> &contact_laws()
{
  return table();
}

void add_contact_law(const ContactLaw &law)
{
  add_to(table(), law);
}

std::int32_t contact_law_number(std::string_view name)
{
  const auto found = find(name);
  if (found != table().end())
    return static_cast<std::int32_t>(found - table().begin());
  std::string names;
  for (const ContactLaw &law : table())
    names += (names.empty() ? "" : ", ") + law.name;
  throw std::invalid_argument("contact law " + std::string(name) +
                              ": must be one of " + names);
}

std::vector<LawValues> default_law_values()
{
  std::vector<LawValues> all;
  for (const ContactLaw &law : table())
  {
    LawValues &values = all.emplace_back();
    for (std::size_t i = 0; i < law.parameters.size(); ++i)
      values.at(i) = law.parameters[i].value;
  }
  return all;
}

LawChoice law_of(const ParticleMaterial &material)
{
  return {contact_law_number(material.law), material.law_values};
}

LawChoice law_of(const WallMaterial &wall)
{
  LawChoice choice{contact_law_number(wall.law), wall.law_values};
  if (wall.law == Linear::name)
    choice.values = {wall.normal_stiffness, wall.shear_stiffness};
  return choice;
}
} // namespace dem
