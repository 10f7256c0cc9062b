#pragma once

#include <dem/parameters/contact_geometry.h>
#include <dem/parameters/overlap_limits.h>

#include <array>
#include <cstddef>
#include <string>

namespace dem
{
/// Most parameters that a contact law may have of its own.
inline constexpr std::size_t max_law_parameters = 4;
/// Values of the parameters of a contact law, in the order of its list.
using LawValues = std::array<double, max_law_parameters>;

/// Particle against particle (article, Table 2).
struct ParticleMaterial
{
  double density = 2750.;        ///< rho [kg/m^3]
  double shear_modulus = 5e8;    ///< G [Pa]
  double poisson_ratio = 0.25;   ///< nu [-]
  double friction = 0.5;         ///< f [-]
  double rolling_friction = 0.2; ///< f_r [-]
  double normal_damping = 0.27;  ///< beta_n [-]
  double shear_damping = 0.27;   ///< beta_s [-]
  std::string law = "hertz";     ///< name of the contact law
  LawValues law_values{};        ///< its parameters
};

/// A body among the particles that is of another material: its contacts take
/// friction and damping of the particles.
struct SolidMaterial
{
  double density = 7850.;      ///< rho [kg/m^3]
  double shear_modulus = 8e10; ///< G [Pa]
  double poisson_ratio = 0.3;  ///< nu [-]
};

/// Particle against boundary (article, Table 2).
struct WallMaterial
{
  /// Name of the law: linear, springs of these stiffnesses (the article);
  /// hertz, particle on a rigid plate, with the curvatures of the particle; ...
  std::string law = "linear";
  double normal_stiffness = 1e8;   ///< k_n of the law linear [N/m]
  double shear_stiffness = 0.85e8; ///< k_s of the law linear [N/m]
  double friction = 0.21;          ///< f_w [-]
  double rolling_friction = 0.;    ///< f_r of the wall [-]
  double normal_damping = 0.62;    ///< beta_nw [-]
  double shear_damping = 0.62;     ///< beta_sw [-]
  LawValues law_values{};          ///< of any other law
};

/// The normal force F_n in the limits f F_n of friction and f_r R F_n of
/// rolling.
enum class FrictionLimit
{
  elastic, ///< of the spring alone (the article)
  total    ///< with its dashpot: the impulse of friction is f that of F_n
};

/// How contacts are found and how soon their data of shapes are renewed: the
/// only part of the skin of the lists.
struct GeometryParameters
{
  ContactGeometry geometry = ContactGeometry::radial; ///< particle on particle
  /// Particle on plane and facet surface. Radii that follow the direction to a
  /// facet would change with every tilt of a light membrane.
  ContactGeometry wall_geometry = ContactGeometry::sphere;
  /// The expansion of a side is renewed when the contact direction has moved
  /// this far in the body frame; 0: every step [rad].
  double refresh_tolerance = 5e-3;
  /// Skin of the lists of candidates, how far beyond contact they look [m];
  /// 0: chosen at each rebuild by SkinWidth, around `usual_skin`.
  double skin = 0.;
  /// Skin of the right order for the sizes of the scene [m]: where SkinWidth
  /// begins and what it stays near; servo walls may not cross it.
  double usual_skin = 1e-3;
  OverlapLimits overlap; ///< of all contacts

  bool follows_surfaces() const
  {
    return traits(geometry).has_common_normal ||
           traits(wall_geometry).has_common_normal;
  }
};
} // namespace dem
