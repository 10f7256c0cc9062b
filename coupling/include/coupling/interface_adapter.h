#pragma once

#include <coupling/contact_tangent.h>
#include <coupling/interface_map.h>
#include <dem/engine_boundaries.h>
#include <dem/exact_sum.h>

#include <memory>

namespace coupling
{
/// Since the engine was made, as the particles book it.
struct InterfaceSums
{
  double work = 0.; ///< of the particles on the boundary [J]
  /// What the boundary has got since forget_impulse [N s].
  Eigen::Vector3d impulse = Eigen::Vector3d::Zero();
};

enum class Collected
{
  load,   ///< at the end of the last step [N]
  impulse ///< since forget_impulse [N s]
};

/// Where some nodes of a body are a boundary of the engine.
class InterfaceAdapter
{
public:
  virtual ~InterfaceAdapter() = default;
  /// The boundary at the end of the coming step, and how fast it moves in it.
  virtual void place(const NodeMotion &motion, dem::Engine &engine) const = 0;
  /// On the nodes; overwrites.
  virtual void collect(const dem::Engine &engine, Collected what,
                       std::span<Eigen::Vector3d> nodal) const = 0;
  virtual void forget_impulse(dem::Engine &engine) const = 0;
  virtual InterfaceSums sums(const dem::Engine &engine) const = 0;
  /// Normal springs of the contacts of this rank that touch, on each node
  /// [N/m].
  virtual void add_stiffness(const dem::Engine &engine,
                             std::span<dem::ExactSum> nodal) const = 0;
  /// How the loads of the contacts of this rank that touch change with the
  /// nodes.
  virtual void add_tangent(const dem::Engine &, ContactTangent &) const {}
  /// Of the first nodes, if they are those of a facet surface; else null.
  virtual const InterfaceMap *facets() const { return nullptr; }
};

/// All nodes are those of a facet surface.
class FacetAdapter : public InterfaceAdapter
{
public:
  FacetAdapter(InterfaceMap its_map, std::size_t surface)
      : map(std::move(its_map)), number(surface)
  {
  }
  void place(const NodeMotion &motion, dem::Engine &engine) const override;
  void collect(const dem::Engine &engine, Collected what,
               std::span<Eigen::Vector3d> nodal) const override;
  void forget_impulse(dem::Engine &engine) const override;
  InterfaceSums sums(const dem::Engine &engine) const override;
  void add_stiffness(const dem::Engine &engine,
                     std::span<dem::ExactSum> nodal) const override;
  void add_tangent(const dem::Engine &engine,
                   ContactTangent &nodal) const override;
  const InterfaceMap *facets() const override { return &map; }

private:
  InterfaceMap map;
  std::size_t number;
};

/// One node is a point of a plane. Planes move by their velocity.
class PlaneAdapter : public InterfaceAdapter
{
public:
  explicit PlaneAdapter(std::size_t plane) : number(plane) {}
  void place(const NodeMotion &motion, dem::Engine &engine) const override;
  void collect(const dem::Engine &engine, Collected what,
               std::span<Eigen::Vector3d> nodal) const override;
  void forget_impulse(dem::Engine &engine) const override;
  InterfaceSums sums(const dem::Engine &engine) const override;
  void add_stiffness(const dem::Engine &engine,
                     std::span<dem::ExactSum> nodal) const override;

private:
  std::size_t number;
};

/// The first nodes are one boundary, the others another.
class SplitAdapter : public InterfaceAdapter
{
public:
  SplitAdapter(std::unique_ptr<InterfaceAdapter> first, std::size_t n_first,
               std::unique_ptr<InterfaceAdapter> second)
      : one(std::move(first)), other(std::move(second)), n(n_first)
  {
  }
  void place(const NodeMotion &motion, dem::Engine &engine) const override;
  void collect(const dem::Engine &engine, Collected what,
               std::span<Eigen::Vector3d> nodal) const override;
  void forget_impulse(dem::Engine &engine) const override;
  InterfaceSums sums(const dem::Engine &engine) const override;
  void add_stiffness(const dem::Engine &engine,
                     std::span<dem::ExactSum> nodal) const override;
  void add_tangent(const dem::Engine &engine,
                   ContactTangent &nodal) const override;
  const InterfaceMap *facets() const override { return one->facets(); }

private:
  std::unique_ptr<InterfaceAdapter> one, other;
  std::size_t n;
};
} // namespace coupling
