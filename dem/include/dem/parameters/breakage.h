#pragma once

namespace dem
{
/// Which contacts may break a particle.
enum class EventContacts
{
  /// Where the overlap follows the surface, so that an event lowers the force.
  seen,
  /// Also where spheres overlap: their force is independent of the event.
  all
};

/// The energy that the criterion compares with G_c A_i.
enum class CriterionEnergy
{
  normal,    ///< of the normal spring (the article)
  with_shear ///< and of the shear spring
};

/// The curvatures of the cap.
enum class CapCurvature
{
  own,     ///< of the particle that breaks (the article)
  relative ///< of the gap between both: the true lens
};

/// What each of two particles gets of overlap and energy.
enum class EnergyShare
{
  full,      ///< all of both (the article)
  compliance ///< its share in the compliance: half, against walls all
};

/// The mode of an event that meets both conditions.
enum class ModePrecedence
{
  instantaneous, ///< II, the factor is lost
  cumulative     ///< I, one is taken off the factor
};

/// Which particles break when both sides of a contact request it.
enum class BrokenSides
{
  larger, ///< the one with the larger E_e / E_b; the other is checked again
  both    ///< one after the other
};

/// How the depth of an event follows from its volume.
enum class DepthClosure
{
  exact,  ///< the volume drops by V_i, by Newton on the nodes
  article ///< zero-mean kernel, a_00 by Eqs. 17, 18
};

/// What keeps the cumulative factor when a contact opens.
enum class FactorMemory
{
  contact, ///< nothing: it is lost (the article)
  patch ///< the patch of the particle: the next contact there continues with it
};

/// The sphere whose radius r_ins defines corners (Eq. 14) and floors
/// curvatures.
enum class InscribedSphereAt
{
  origin, ///< of the series
  free    ///< the largest sphere inside
};

/// Parameters of the energy criterion (article, Table 2) and its choices.
struct BreakageParameters
{
  bool is_active = true; ///< particles may break at all
  /// A rise of the energy above what it has been since this was set counts so
  /// many times, as if the load came back as often; one that makes up for a
  /// fall counts once. 0: factors stay as they are and nothing breaks [-]
  double repetitions = 1.;
  double fracture_energy = 1e4; ///< G_c, breakage energy per area [J/m^2]
  double min_equivalent_radius = 2e-3; ///< no further breakage below this [m]
  double min_diameter = 7.1e-3;        ///< breakable from this initial size [m]
  double curvature_floor_ratio = 10;   ///< beta in kappa_f = 1/(beta r_ins) [-]
  double kernel_floor = 2.5;           ///< c_lambda in lambda >= c / N_s [-]
  double kernel_scale = 1.; ///< s in lambda = s sqrt(delta R) / r [-]
  /// Rings of the rule that measures a particle again after an event (volume,
  /// inscribed radius, depth of the chip): 2 n^2 nodes.
  int quadrature_rings = 40;
  /// Cycles of the energy below this share of it do not count [-]
  double hysteresis = 0.01;
  EventContacts contacts = EventContacts::seen;
  CriterionEnergy energy = CriterionEnergy::normal;
  CapCurvature curvature = CapCurvature::own;
  EnergyShare share = EnergyShare::full;
  ModePrecedence precedence = ModePrecedence::instantaneous;
  BrokenSides sides = BrokenSides::larger;
  DepthClosure closure = DepthClosure::exact;
  FactorMemory memory = FactorMemory::contact;
  InscribedSphereAt inscribed = InscribedSphereAt::origin;

  /// Whether contacts must store the reversals of their energy.
  bool needs_reversal() const
  {
    return hysteresis > 0. || energy == CriterionEnergy::with_shear;
  }
};
} // namespace dem
