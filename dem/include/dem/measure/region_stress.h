#pragma once

#include <dem/measure/network.h>

#include <optional>
#include <utility>

namespace dem
{
/// An upright prism over a convex polygon.
struct Prism
{
  std::vector<Eigen::Vector2d> corners; ///< counter-clockwise from above [m]
  double low = 0., high = 0.;           ///< z of its ends [m]

  double volume() const; ///< [m^3]
};

/// The prism of a box.
Prism prism_of(const Vec3 &lower, const Vec3 &upper);

/// An upright cylinder: the regular prism of 72 sides of its volume.
Prism prism_of_cylinder(const Eigen::Vector2d &centre, double radius,
                        double low, double high);

/// Corners of the convex polygon through these points, in their right order;
/// points on straight sides are left out [m].
std::vector<Eigen::Vector2d>
corners_through(std::vector<Eigen::Vector2d> points);

/// What is left of a prism without a skin of this thickness [m]: every face is
/// moved inward. Throws std::invalid_argument if nothing is.
Prism without_skin(const Prism &prism, double skin);

/// Part of the straight line from one point to another that is in the prism, as
/// shares of its length from the start; none if it is outside [-].
std::optional<std::pair<double, double>>
part_inside(const Prism &prism, const Vec3 &from, const Vec3 &to);

/// -sum F (x) d over all contacts, d from the centre of A to that of B, or to
/// the point on a wall: volume times mean stress of all particles, compression
/// positive (Love 1927, Weber 1966) [J].
Mat3 contact_virial(const ParticleSystem &particles, const Network &network);

/// Mean stress in the prism, -1/V sum sym(F (x) d) over the contacts, d being
/// the part inside of the line from the centre of A to that of B, or to the
/// point on a wall: a contact hands its force over along this line (Goldhirsch
/// 2010), so that the volume is that of the prism and no particle is counted to
/// be in or out. Compression positive; motion of the particles left out [Pa].
Mat3 mean_stress(const Prism &prism, const ParticleSystem &particles,
                 const Network &network);
} // namespace dem
