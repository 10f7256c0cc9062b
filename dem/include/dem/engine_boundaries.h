#pragma once

#include <dem/boundary/drum_boundary.h>
#include <dem/boundary/facet_boundary.h>
#include <dem/boundary/mesh_wall.h>
#include <dem/boundary/plane_boundary.h>
#include <dem/engine.h>

#include <functional>
#include <stdexcept>

/// The boundaries that come with the library, in an engine.
namespace dem
{
/// The first boundary of a class, or null.
template <class Kind>
Kind *find_boundary(Engine &engine)
{
  for (const auto &boundary : engine.boundaries())
    if (auto *found = dynamic_cast<Kind *>(boundary.get()))
      return found;
  return nullptr;
}
template <class Kind>
const Kind *find_boundary(const Engine &engine)
{
  for (const auto &boundary : engine.boundaries())
    if (const auto *found = dynamic_cast<const Kind *>(boundary.get()))
      return found;
  return nullptr;
}

/// The planes, of the material EngineParameters::wall; empty at first.
std::vector<Plane> &planes(Engine &engine);
const std::vector<Plane> &planes(const Engine &engine);
/// Returns the number of the plane.
std::size_t add_plane(Engine &engine, const Vec3 &point, const Vec3 &normal);
/// Particles do not see it any more.
void deactivate_plane(Engine &engine, std::size_t plane);
/// Puts a plane elsewhere, where it is active and at rest.
void place_plane(Engine &engine, std::size_t plane, const Vec3 &point);
/// Contacts with planes; `b` is the plane.
const ContactBatch &on_planes(const Engine &engine);

/// The drum of the scene (one), of the material EngineParameters::wall. Its
/// spin and widening may change at any time. drum() throws std::logic_error
/// where there is none; of a const engine it is then one of radius 0.
void set_drum(Engine &engine, const Drum &drum);
Drum &drum(Engine &engine);
const Drum &drum(const Engine &engine);
const ContactBatch &on_drum(const Engine &engine);

/// Adds a facet surface; returns its number. Throws std::invalid_argument on a
/// surface that is none, or a label that is taken.
std::size_t add_surface(Engine &engine, const std::string &label,
                        const WallMaterial &material, FacetSurface surface);
/// Adds one of the material EngineParameters::surface; library only.
void attach_surface(Engine &engine, FacetSurface surface);
/// The facet surfaces in the order in which they were added.
std::vector<std::reference_wrapper<FacetBoundary>> surfaces(Engine &engine);
std::vector<std::reference_wrapper<const FacetBoundary>>
surfaces(const Engine &engine);
/// One of them, and its parts; throw std::out_of_range if it is not there.
inline FacetBoundary &facet_boundary(Engine &engine, std::size_t number = 0)
{
  return surfaces(engine).at(number);
}
inline const FacetBoundary &facet_boundary(const Engine &engine,
                                           std::size_t number = 0)
{
  return surfaces(engine).at(number);
}
inline FacetSurface &surface(Engine &engine, std::size_t number = 0)
{
  return facet_boundary(engine, number).surface;
}
inline const FacetSurface &surface(const Engine &engine, std::size_t number = 0)
{
  return facet_boundary(engine, number).surface;
}
inline const ContactBatch &on_facets(const Engine &engine,
                                     std::size_t number = 0)
{
  return facet_boundary(engine, number).batch;
}

/// Adds a rigid wall of any shape, which is at its motion from now on; returns
/// its number. Throws std::invalid_argument on a surface that is none, or a
/// label that is taken.
std::size_t add_mesh_wall(Engine &engine, const std::string &label,
                          const WallMaterial &material, FacetSurface surface,
                          const WallMotion &motion);
/// All facets that particles meet: surfaces() and mesh walls.
std::vector<std::reference_wrapper<const FacetBoundary>>
all_facets(const Engine &engine);
/// The mesh walls in the order in which they were added; surfaces() does not
/// have them.
std::vector<std::reference_wrapper<const MeshWall>>
mesh_walls(const Engine &engine);
std::vector<std::reference_wrapper<MeshWall>> mesh_walls(Engine &engine);
} // namespace dem
