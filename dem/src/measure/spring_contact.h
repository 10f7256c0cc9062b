#pragma once

#include <dem/contact/law_table.h>
#include <dem/engine.h>
#include <dem/integrate/stable_step.h>

namespace dem
{
/// One contact on its way into the columns.
struct SpringContact
{
  std::int32_t a = 0;
  std::array<FarShare, 4> b{};
  Vec3 normal = Vec3::UnitX(), lever_a = Vec3::Zero(), lever_b = Vec3::Zero();
  double normal_stiffness = 0., shear_stiffness = 0.; ///< [N/m]
  double rolling_radius = 0.;                         ///< [m]
  double reduced_mass = 0.;                           ///< of the dashpots [kg]
  double hertz_prefactor = 0.; ///< C_H; 0: constant stiffness [N/m^(3/2)]
  double closing_speed = 0.;   ///< now, along the normal; < 0: opening [m/s]
  double stored = 0.;          ///< by the normal spring now [J]
  ContactCoefficients coefficients;
};

/// How far ahead contacts are foreseen, and which of them count as impacts.
struct Foresight
{
  double horizon = 0.;      ///< 0: contacts as they stand [s]
  double least_energy = 0.; ///< of an impact that counts [J]
  double gained_speed = 0.; ///< by gravity before the horizon [m/s]
};

/// With a horizon [s] at this state of the engine; none: nothing is foreseen.
Foresight foresight_of(const Engine &engine, double horizon);

/// Adds the springs and dashpots of the contact to the columns, and the contact
/// to the impacts where it is one.
void append(SpringNetwork &network, const SpringContact &c,
            const Foresight &ahead);

/// Where particles come further before the horizon than the lists see, those
/// that have nothing near may yet have an impact: on a Hertz plate, or a
/// particle that does not give way, when both are as fast as the fastest. What
/// is linear is as stiff at any speed.
void add_impacts(const Engine &engine, const Foresight &ahead,
                 SpringNetwork &network);
} // namespace dem
