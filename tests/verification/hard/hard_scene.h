#pragma once

#include "coupled_scene.h"
#include "hard_case.h"

#include <coupling/membrane_body.h>

namespace hard
{
/// Particles and bodies that are saved and restored together.
struct Scene
{
  dem::Engine engine;
  coupling::Exchange exchange;
  coupling::ShapeLibrary shapes;
  std::vector<coupling::DeformableBody *> bodies;

  explicit Scene(const dem::EngineParameters &parameters,
                 const coupling::ExchangeParameters &rules = {},
                 coupling::ShapeLibrary library = {});

  coupling::DeformableBody &add(std::unique_ptr<coupling::DeformableBody> body,
                                const fem::SurfaceMesh &mesh,
                                const std::string &name,
                                coupling::ParticleSide side);
  /// A rigid plate of side 40 mm that moves along z.
  coupling::DeformableBody &
  add_plate(double mass, double z, const std::function<double(double)> &force,
            const coupling::BodySteps &steps = {});
  /// n x n quads on a square in z = 0 with its rim tied, particles above.
  fem::Membrane &add_sheet(const fem::MembraneParameters &membrane, double side,
                           int n);

  void advance(double window);
  /// What came from outside less what is there and lost [J].
  double residual() const;
  std::string state() const;
  void restore(const std::string &from);
};

using Make = std::function<std::unique_ptr<Scene>()>;
/// What happens before (drives) or after (looks) window k.
using Script = std::function<void(Scene &, int)>;

struct Course
{
  double window = 0.; ///< [s]
  int n = 0;          ///< windows
  Script before, after;
};

/// Runs the scene through; then its second half again, from what was saved in
/// the middle.
Restart run(const Make &make, const Course &course);

/// Spring, friction and damping of the walls of the article, 1e8 N/m.
dem::EngineParameters stiff_parameters();
/// 1 mm of latex under 200 N/m.
fem::MembraneParameters latex();
/// Longest step of one particle on one free node [s], see
/// docs/theory/interface.md.
double contact_step(const dem::WallMaterial &contact, double node_mass,
                    double particle_mass);
} // namespace hard
