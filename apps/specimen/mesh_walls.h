#pragma once

#include "case/case.h"

#include <dem/engine.h>
#include <dem/integrate/time_step.h>
#include <dem/shape/fit.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace spall
{
/// Triangles of a STL, PLY, OBJ or gmsh file, whose unit is `scale` [m]. Throws
/// std::invalid_argument, also for more than 100 m, or InputError.
dem::TriangleMesh read_wall_mesh(const std::string &path, double scale);

/// Adds the walls of the case to a scene, whose coordinates have the origin of
/// the case at `origin` [m]. Throws InputError on a mesh or a table that cannot
/// be one.
void add_mesh_walls(dem::Engine &engine, const Case &parameters,
                    const dem::Vec3 &origin = dem::Vec3::Zero());

/// Whether a sphere about a point is clear of the walls of the case as they are
/// at first; empty without any. Throws InputError as add_mesh_walls().
std::function<bool(const dem::Vec3 &, double)>
clear_of_walls(const Case &parameters,
               const dem::Vec3 &origin = dem::Vec3::Zero());

/// `limit`, or the one of a particle on a wall of the case if that is shorter.
dem::StepLimit limit_on_walls(const Case &parameters,
                              const dem::EngineParameters &engine,
                              const dem::ParticleSystem &particles,
                              const dem::StepLimit &limit);

/// Columns of history.csv about the walls of a scene, each with its value now:
/// force and moment of the particles on each of them, displacement, rotation,
/// and what sliding on it has dissipated.
std::vector<std::pair<std::string, double>>
wall_quantities(const dem::Engine &engine);
} // namespace spall
