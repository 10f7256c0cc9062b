#pragma once

#include <dem/contact/law.h>
#include <dem/instruction_set.h>

#include <string>

namespace dem
{
namespace kernel
{
struct Loops;
}

/// A contact law as all but the loops see it.
struct ContactLaw
{
  std::string name;
  double exponent = 1.;               ///< see NormalLaw
  bool scales_with_curvature = false; ///< see NormalLaw
  bool attracts = false;              ///< see NormalLaw
  std::vector<LawParameter> parameters;
  double (*range)(const LawValues &) = nullptr; ///< attraction_range [m]
  NormalSpring<double> (*spring)(const LawValues &, const Prefactors<double> &,
                                 const double &overlap) = nullptr;
  double (*energy)(const LawValues &, const double &force,
                   const double &overlap) = nullptr;
  /// Loops over contacts of the instruction set in use.
  const kernel::Loops &(*loops)() = nullptr;
};

/// The entry of a law whose loops are these.
template <class Law>
ContactLaw contact_law_entry(const kernel::Loops &(*loops)())
{
  return {Law::name,
          Law::exponent,
          Law::scales_with_curvature,
          Law::attracts,
          Law::parameters(),
          attraction_range<Law>,
          Law::template spring<double>,
          Law::template energy<double>,
          loops};
}

/// The loops of a law by the instruction set in use, from those that
/// spall_add_loops() of CMake has compiled for each.
template <const kernel::Loops &baseline, const kernel::Loops &avx2,
          const kernel::Loops &avx512>
const kernel::Loops &loops_by_instruction_set()
{
  const InstructionSet set = instruction_set();
  return set == InstructionSet::avx512 ? avx512
         : set == InstructionSet::avx2 ? avx2
                                       : baseline;
}

/// All laws: those of ContactLaws, then those that were added.
const std::vector<ContactLaw> &contact_laws();

/// Adds a law of a program of its own, before any engine is built. Throws
/// std::invalid_argument if its name or a key of its parameters is that of
/// another law, or if it has more than max_law_parameters.
void add_contact_law(const ContactLaw &law);

/// Number of the law of this name; throws std::invalid_argument with the names
/// that there are.
std::int32_t contact_law_number(std::string_view name);

/// The defaults of the parameters of all laws, by number.
std::vector<LawValues> default_law_values();

/// A law with its values.
struct LawChoice
{
  std::int32_t law = 0; ///< number in contact_laws()
  LawValues values{};

  const ContactLaw &entry() const
  {
    return contact_laws()[static_cast<std::size_t>(law)];
  }
  double range() const { return entry().range(values); } ///< [m]
  /// Of a law of exponent 1 without prefactors, whose stiffness is constant.
  NormalSpring<double> constant_spring() const
  {
    return entry().spring(values, {}, 1.);
  }
};

/// Law of particles on each other, or on a wall; throws std::invalid_argument
/// on a name that is none.
LawChoice law_of(const ParticleMaterial &material);
LawChoice law_of(const WallMaterial &wall);

/// Coefficients of particles on each other, or on a wall.
template <class Material>
ContactCoefficients coefficients_of(const Material &material)
{
  return {material.friction, material.rolling_friction, material.normal_damping,
          material.shear_damping};
}
} // namespace dem
