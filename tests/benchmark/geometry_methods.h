#pragma once

#include <dem/neighbor/contact_points.h>

#include <optional>

/// Ways to say where two particles meet, each from nothing but their shapes.
namespace spall
{
/// Where two particles meet, in the body frame of A.
struct Meeting
{
  double overlap = 0.;                   ///< > 0 where they overlap [m]
  dem::Vec3 normal = dem::Vec3::UnitX(); ///< from A to B, unit [-]
  dem::Vec3 arm = dem::Vec3::Zero();     ///< from the centre of A [m]
  bool is_found = true;
};

/// Overlap of the balls.
Meeting by_balls(const dem::MappedPair &pair);

/// Overlap of the local radii along the branch.
Meeting by_radii(const dem::MappedPair &pair);

/// The same, corrected so many times by the height functions of both surfaces
/// over the plane across the branch; 1 or more.
Meeting by_heights(const dem::MappedPair &pair, int n_corrections);

/// The deepest contact point that a search from nothing finds; margin
/// as in dem::find_contact_points() [m].
Meeting by_search(const dem::MappedPair &pair, double margin);

/// The contact point that Newton steps from a start find.
Meeting by_refinement(const dem::MappedPair &pair,
                      const dem::ContactPoint &start);

/// The deepest contact point of a search. Its is_found is false without any.
dem::ContactPoint deepest_contact_point(const dem::MappedPair &pair,
                                        double margin);

/// B moves along the branch until its deepest contact point just touches A.
/// Nothing if the search loses the contact point on the way: flat faces have no
/// lens of contact.
std::optional<dem::MappedPair> bring_together(const dem::MappedPair &from);
} // namespace spall
