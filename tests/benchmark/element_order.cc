// What elements of order two would be worth in the ground: settlement of a
// loaded patch on the layers of data/cases/subgrade_quick.prm, by the cells of
// fem/ and by those of deal.II of orders one and two on the same meshes, each
// with the cost of a second of explicit steps. Table of
// docs/verification/continuum.md.
//
//   element_order
#include "brute_force.h"

#include <fem/solid.h>
#include <fem/solid_surface.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/precondition.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/vector.h>
#include <deal.II/numerics/vector_tools.h>

#include <cstdio>

namespace
{
using Vector = Eigen::Vector3d;
using Field = dealii::Vector<double>;
using support::processor_time;

constexpr double half_plate = 0.075, side = 1., depth = 1.2,
                 upper_layer = 0.3, // [m]
    pressure = 85e3;                // [Pa]
const std::vector<fem::SolidLayer> layers{{30e6, 0.35, 1800.},
                                          {60e6, 0.3, 1900.}};

const fem::SolidLayer &layer_at(double z)
{
  return layers[z > -upper_layer];
}

/// What a mesh with its elements gives.
struct Outcome
{
  std::size_t n_unknowns = 0;
  double settlement = 0.;  ///< of the loaded patch, mean [m]
  double stable_step = 0.; ///< 2 / omega_max, lumped mass [s]
  double step = 0.;        ///< processor time of an explicit step [s]

  double second() const { return step / stable_step; }
};

/// Widths of the cells of a quarter x, y > 0 from the middle outward and from
/// the bottom up, halved `level` times [m].
std::array<std::vector<double>, 3> widths(int level)
{
  constexpr double growth = 1.56; // 1.25 on the mesh halved once
  std::vector<double> out{half_plate};
  std::ranges::copy(fem::graded_widths(half_plate, growth, side - half_plate),
                    std::back_inserter(out));
  std::vector<double> down =
      fem::graded_widths(half_plate, growth, upper_layer);
  std::ranges::copy(
      fem::graded_widths(down.back() * growth, growth, depth - upper_layer),
      std::back_inserter(down));
  std::array<std::vector<double>, 3> all{
      out, out, std::vector<double>(down.rbegin(), down.rend())};
  for (std::vector<double> &along : all)
    for (int k = 0; k < level; ++k)
    {
      std::vector<double> halves;
      for (const double width : along)
        halves.insert(halves.end(), 2, 0.5 * width);
      along = halves;
    }
  return all;
}

/// Seconds of one call, of many.
template <class Step>
double time_of(const Step &step)
{
  step();
  int n = 0;
  const double start = processor_time();
  while (processor_time() - start < 0.5)
  {
    step();
    ++n;
  }
  return (processor_time() - start) / n;
}

Outcome cells_of_fem(int level)
{
  fem::BoxMesh box;
  box.lower = {0., 0., -depth};
  box.widths = widths(level);
  fem::SolidMesh mesh = fem::box_mesh(box);
  fem::assign_layers(mesh, std::array{-upper_layer, 0.});
  fem::SolidParameters p;
  p.layers = layers;
  p.solver = fem::SolidSolver::amg;
  fem::Solid ground(p, mesh);
  ground.fix(fem::x_lower, {true, false, false});
  ground.fix(fem::y_lower, {false, true, false});
  for (const auto rigid : {fem::x_upper, fem::y_upper, fem::z_lower})
    ground.fix(rigid, {true, true, true});
  const auto loads =
      fem::traction_loads(mesh, fem::z_upper,
                          [](const Vector &x)
                          {
                            const bool is_loaded =
                                x.head<2>().maxCoeff() < half_plate;
                            return Vector(0., 0., is_loaded ? -pressure : 0.);
                          });
  ground.settle(loads);
  Outcome o;
  o.n_unknowns = 3 * mesh.nodes.size();
  double sum = 0.;
  for (std::size_t k = 0; k < loads.size(); ++k)
  {
    sum += loads[k].z();
    o.settlement += loads[k].z() * ground.displacements()[k].z();
  }
  o.settlement /= -sum;
  o.stable_step = ground.stable_time_step().time_step;
  o.step = time_of(
      [&]
      {
        ground.begin_step(0.5 * o.stable_step);
        ground.end_step(loads, 0.5 * o.stable_step);
      });
  return o;
}

/// Stiffness matrix of a cell, of orders up to two.
void stiffness(const dealii::FEValues<3> &values, const fem::SolidLayer &layer,
               dealii::FullMatrix<double> &matrix)
{
  const double mu = layer.youngs_modulus / (2. * (1. + layer.poisson_ratio)),
               lambda = 2. * mu * layer.poisson_ratio /
                        (1. - 2. * layer.poisson_ratio);
  const dealii::FEValuesExtractors::Vector displacement(0);
  const auto &u = values[displacement];
  const unsigned int n = values.dofs_per_cell;
  matrix = 0.;
  for (const unsigned int q : values.quadrature_point_indices())
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        matrix(i, j) +=
            values.JxW(q) *
            (lambda * u.divergence(i, q) * u.divergence(j, q) +
             2. * mu *
                 (u.symmetric_gradient(i, q) * u.symmetric_gradient(j, q)));
}

/// The ground on Lagrange elements of deal.II, mass lumped by the points of
/// Gauss and Lobatto, matrix assembled.
class LagrangeGround
{
public:
  LagrangeGround(unsigned int order, int level)
      : element(dealii::FE_Q<3>(order), 3), handler(mesh)
  {
    const auto along = widths(level);
    const dealii::Point<3> lower(0., 0., -depth), upper(side, side, 0.);
    dealii::GridGenerator::subdivided_hyper_rectangle(
        mesh, std::vector(along.begin(), along.end()), lower, upper, true);
    handler.distribute_dofs(element);
    hold();
    dealii::DynamicSparsityPattern drawn(handler.n_dofs());
    dealii::DoFTools::make_sparsity_pattern(handler, drawn, held, false);
    pattern.copy_from(drawn);
    matrix.reinit(pattern);
    mass.reinit(handler.n_dofs());
    load.reinit(handler.n_dofs());
    assemble();
  }

  Outcome outcome()
  {
    Field u(load.size()), next(load.size());
    dealii::SolverControl control(20000, 1e-10 * load.l2_norm());
    dealii::SolverCG<Field> solver(control);
    dealii::PreconditionSSOR<dealii::SparseMatrix<double>> ssor;
    ssor.initialize(matrix, 1.2);
    solver.solve(matrix, u, load, ssor);
    held.distribute(u);
    Outcome o;
    o.n_unknowns = handler.n_dofs();
    o.settlement = (load * u) / total_load;
    o.stable_step = 2. / std::sqrt(largest_eigenvalue());
    o.step = time_of([&] { matrix.vmult(next, u); });
    return o;
  }

private:
  void hold()
  {
    const dealii::Functions::ZeroFunction<3> zero(3);
    for (const unsigned int rigid : {1u, 3u, 4u})
      dealii::VectorTools::interpolate_boundary_values(handler, rigid, zero,
                                                       held);
    for (const unsigned int c : {0u, 1u}) // planes of symmetry
    {
      dealii::ComponentMask across(3, false);
      across.set(c, true);
      dealii::VectorTools::interpolate_boundary_values(handler, 2 * c, zero,
                                                       held, across);
    }
    held.close();
  }

  void assemble()
  {
    using namespace dealii;
    const QGauss<3> points(element.degree + 1);
    const QGaussLobatto<3> nodes(element.degree + 1);
    const QGauss<2> face_points(element.degree + 1);
    FEValues<3> values(element, points, update_gradients | update_JxW_values),
        at_nodes(element, nodes, update_values | update_JxW_values);
    FEFaceValues<3> on_face(element, face_points,
                            update_values | update_JxW_values);
    const unsigned int n = element.n_dofs_per_cell();
    FullMatrix<double> k(n, n);
    Field f(n), m(n);
    std::vector<types::global_dof_index> rows(n);
    for (const auto &cell : handler.active_cell_iterators())
    {
      values.reinit(cell);
      at_nodes.reinit(cell);
      const fem::SolidLayer &layer = layer_at(cell->center()[2]);
      stiffness(values, layer, k);
      f = 0.;
      m = 0.;
      for (unsigned int i = 0; i < n; ++i)
        for (const unsigned int q : at_nodes.quadrature_point_indices())
          m(i) += layer.density * at_nodes.JxW(q) *
                  std::pow(at_nodes.shape_value(i, q), 2);
      for (const unsigned int face : cell->face_indices())
        if (cell->face(face)->at_boundary() &&
            cell->face(face)->boundary_id() == 5 &&
            std::max(cell->center()[0], cell->center()[1]) < half_plate)
          press(cell, face, on_face, f);
      cell->get_dof_indices(rows);
      held.distribute_local_to_global(k, f, rows, matrix, load);
      for (unsigned int i = 0; i < n; ++i)
        mass(rows[i]) += m(i);
    }
  }

  template <class Cell>
  void press(const Cell &cell, unsigned int face,
             dealii::FEFaceValues<3> &on_face, Field &f)
  {
    on_face.reinit(cell, face);
    for (const unsigned int q : on_face.quadrature_point_indices())
    {
      for (unsigned int i = 0; i < f.size(); ++i)
        f(i) -=
            pressure * on_face.shape_value_component(i, q, 2) * on_face.JxW(q);
      total_load += pressure * on_face.JxW(q);
    }
  }

  /// Of stiffness over lumped mass, by power iteration [1/s^2].
  double largest_eigenvalue() const
  {
    Field v(load.size()), next(load.size());
    for (unsigned int i = 0; i < v.size(); ++i)
      v(i) = held.is_constrained(i) ? 0. : std::sin(1. + 7.3 * i);
    double value = 0.;
    for (int k = 0; k < 400; ++k)
    {
      v /= v.l2_norm();
      matrix.vmult(next, v);
      for (unsigned int i = 0; i < v.size(); ++i)
        next(i) = held.is_constrained(i) ? 0. : next(i) / mass(i);
      value = next.l2_norm();
      v.swap(next);
    }
    return value;
  }

  dealii::Triangulation<3> mesh;
  dealii::FESystem<3> element;
  dealii::DoFHandler<3> handler;
  dealii::AffineConstraints<double> held;
  dealii::SparsityPattern pattern;
  dealii::SparseMatrix<double> matrix;
  Field mass, load;
  double total_load = 0.; ///< [N]
};

void print(const char *name, int level, const Outcome &o, double exact)
{
  std::printf("| %s | %d | %zu | %.2f %% | %.3g | %.3g | %.3g |\n", name,
              2 << level, o.n_unknowns, 100. * (o.settlement / exact - 1.),
              1e6 * o.stable_step, 1e3 * o.step, o.second());
  std::fflush(stdout);
}
} // namespace

int main()
{
  // Two meshes of order two, whose error falls by four or more.
  std::array<Outcome, 3> order_two;
  for (int level = 0; level < 3; ++level)
    order_two[static_cast<std::size_t>(level)] =
        LagrangeGround(2, level).outcome();
  const double change = order_two[2].settlement - order_two[1].settlement,
               last = order_two[1].settlement - order_two[0].settlement,
               ratio = last / change,
               exact = order_two[2].settlement + change / (ratio - 1.);
  std::printf("limit %.6g m, the finest mesh of order two is off by %.4f %%\n",
              exact, 100. * (order_two[2].settlement / exact - 1.));
  std::puts("| element | across the plate | unknowns | settlement off by | "
            "stable step [us] | a step [ms] | a second of steps [s] |\n"
            "|---|---|---|---|---|---|---|");
  for (int level = 0; level < 4; ++level)
    print("order one with incompatible modes (fem)", level, cells_of_fem(level),
          exact);
  for (int level = 0; level < 4; ++level)
    print("order one", level, LagrangeGround(1, level).outcome(), exact);
  for (int level = 0; level < 3; ++level)
    print("order two", level, order_two[static_cast<std::size_t>(level)],
          exact);
}
