#pragma once

#include <dem/contact/law.h>
#include <dem/contact/narrow.h>
#include <dem/contact/range_sum.h>

#include <cstdint>

/// The force loops over contacts as they are compiled for each instruction set.
/// Plain pointers only: what is inline here would otherwise be linked from the
/// unit with the widest instructions.
namespace dem::kernel
{
/// ParticleState in numbers, and where its fields are.
inline constexpr int particle_row = 16, at_position = 0, at_radius = 3,
                     at_velocity = 4, at_mass = 7, at_spin = 8, at_inertia = 11,
                     at_orientation = 12;

/// ParticleLoad in numbers: force, moment, two to fill the line.
inline constexpr int load_row = 8, at_moment = 3;

/// What the loops read of the particles and the loads that they add to.
struct ParticleSystem
{
  const double *state;
  const double *path_length; ///< ParticleSystem::path_length, null: spheres
  double gap_path;           ///< PathLengths::gaps, of any two spheres [m]
  double cell_path;          ///< PathLengths::cell, of any two images [m]
  double *load;              ///< ParticleLoad
  double *halo;              ///< ParticleLoad, rows of PairLoads
};

template <class Number>
struct Vectors
{
  Number *x, *y, *z;
};

/// Components along two tangents.
template <class Number>
struct Planars
{
  Number *x, *y;
};

/// SideColumns, renewed by Surfaces; those that its layout leaves out are null.
struct Side
{
  Vectors<const Narrow> direction;
  const double *radius;
  Vectors<const Narrow> gradient;
  const Narrow *hessian[6];

  Vectors<const Narrow> normal;
  const double *height;
  Planars<const Narrow> aside;
  const Narrow *shape_operator[3];
  Planars<Narrow> offset;
};

/// ContactBatch; columns that its layout leaves out are null.
struct Contacts
{
  const std::int32_t *a, *b;
  Vectors<double> shear, rolling;
  Vectors<Narrow> dashpot;
  double *load; ///< ParticleLoad, against walls
  const std::int32_t *target;
  double *overlap, *reactivation, *normal_force, *shear_compliance,
      *rolling_compliance;
  Side side_a, side_b;
  const double *normal_prefactor, *shear_prefactor;
  Narrow *torsion_angle;
  double *overlap_offset; ///< null unless contacts follow their surfaces
  double *factor_a, *factor_b;
  const Narrow *corner_a, *corner_b;
  Narrow *reversal;
  double *peak;
  std::uint8_t *event;
  double *normal_energy; ///< of laws that attract; else null
  double *attraction;
  const Narrow *reduced_radius;
};

/// Columns that the loops prefetch; none where all
/// contacts fit into the cache.
struct ColumnsAhead
{
  static constexpr int n_most = 64;
  int n = 0;
  const char *start[n_most];
  std::int64_t entry_size[n_most]; ///< [bytes]
};

/// What is rare and costly, done contact by contact outside of the lanes.
struct Surfaces
{
  void *owner;
  /// Evaluates side 0 (A) or 1 (B) of contact k at this body direction; null:
  /// where its contact is.
  void (*renew)(void *owner, std::int64_t k, int side, const double *direction);
  /// Mixes the prefactors of contact k with this normal.
  void (*mix)(void *owner, std::int64_t k, const double *normal);
  /// Searches again for the contact point of contact k, which its steps have
  /// lost. Returns how far the surfaces are apart there, < 0 if they overlap; 0
  /// if there is none.
  double (*relocate)(void *owner, std::int64_t k, RangeSum *sum);
};

/// Simd that are worked on in turn make one block for every instruction set.
inline constexpr std::int64_t lane_block = 8;

/// WallRow in numbers.
inline constexpr int wall_row = 16;

/// A wall farther than this many equivalent radii is none: the surface of the
/// particle towards it is not checked.
inline constexpr double far_wall = 1e3;

/// ContactBatch::overlap_offset from here on: the contact has lost its contact
/// point and stays open until the lists are rebuilt [m].
inline constexpr double closed_offset = 1e9;

/// What a loop reads besides the contacts; coefficients are of its batch.
struct Task
{
  ParticleSystem particles;
  Contacts contacts;
  ColumnsAhead ahead;
  Surfaces surfaces;
  ContactCoefficients coefficients;
  double time_step;
  LawValues law; ///< values of the parameters of the law
  double range;  ///< attraction_range of the law [m]
  /// Laws that scale with curvature, spheres: C = normal_factor sqrt(R), C_s =
  /// shear_factor sqrt(R).
  double normal_factor, shear_factor;
  double refresh_tolerance; ///< of the sides [rad]
  bool reads_surface;       ///< sides are kept up to date
  bool is_radial;           ///< overlap from the sides, not from the spheres
  bool has_damage;
  double fracture_energy; ///< G_c [J/m^2]
  double repetitions;     ///< BreakageParameters::repetitions [-]
  double hysteresis;      ///< of the counted energy [-]
  bool counts_shear;  ///< the energy of the criterion is that of both springs
  bool keeps_factors; ///< patches take the factors of contacts that end
  bool is_periodic;   ///< pairs meet at their nearest images
  double cell_length[3], cell_rate[3]; ///< PeriodicCell; 0: not periodic
  /// rounding_shift() of SumGrid; 0: nothing is rounded.
  double force_shift, moment_shift;
  bool adds_loads_only;       ///< forces are taken as the last step left them
  const double *walls;        ///< WallRow
  const double *wall_overlap; ///< by row; null unless found before
  const double *wall_extra;   ///< Walls::extra; null if there is none
};

/// One step of the contacts [first, last); `first` is a multiple of the block.
using Loop = void (*)(const Task &task, std::int64_t first, std::int64_t last,
                      RangeSum &sum);

/// The loops of one law by geometry; null where the law has none.
struct Loops
{
  Loop pairs;          ///< spheres, or radii along the branch
  Loop walls;          ///< the same on planes
  Loop surface_pairs;  ///< true surfaces at their common normals
  Loop surface_walls;  ///< true surfaces at their support points
  Loop followed_walls; ///< true surfaces whose contact points were found before
};

/// The loops of the laws by number, of one instruction set.
namespace baseline
{
extern const Loops *const contact_kernels;
}
namespace avx2
{
extern const Loops *const contact_kernels;
}
namespace avx512
{
extern const Loops *const contact_kernels;
}
} // namespace dem::kernel
