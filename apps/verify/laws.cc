#include "families.h"
#include "laws_cases.h"
#include "reference_table.h"

#include <dem/contact/elliptic.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

// docs/theory/elliptic.md (Johnson 1985, 4.2; Mindlin 1949): formulas without a
// scene.
namespace spall::verify
{
namespace
{
dem::Elasticity body_of(const ReferenceTable &table, std::size_t row,
                        const std::string &side)
{
  dem::Elasticity body;
  body.shear_modulus = table.value(row, "shear_" + side + "_Pa");
  body.poisson_ratio = table.value(row, "poisson_" + side + "_1");
  body.is_rigid = body.shear_modulus == 0.; // so written in the table
  return body;
}

dem::PairCurvatures curvatures_of(const ReferenceTable &table, std::size_t row)
{
  const double psi = table.value(row, "psi_deg") * std::numbers::pi / 180.;
  return {table.value(row, "first_a_1_m"), table.value(row, "second_a_1_m"),
          table.value(row, "first_b_1_m"), table.value(row, "second_b_1_m"),
          std::cos(2. * psi)};
}

/// Largest relative errors over the rows of the table.
struct WorstErrors
{
  double gap = 0., axes = 0., force = 0., stiffness = 0., energy = 0.;
  double shear = 0., fit = 0., shear_fit = 0.;
};

void raise(double &worst, double value, double exact)
{
  worst = std::max(worst, std::abs(value / exact - 1.));
}

WorstErrors worst_errors(const ReferenceTable &table)
{
  WorstErrors worst;
  for (std::size_t k = 0; k < table.size(); ++k)
  {
    const auto exact = [&](const char *column)
    { return table.value(k, column); };
    const dem::PairElasticity pair =
        dem::mix(body_of(table, k, "a"), body_of(table, k, "b"));
    const dem::GapCoefficients gap =
        dem::gap_coefficients(curvatures_of(table, k));
    const double overlap = exact("overlap_m"), root = std::sqrt(overlap);
    const dem::EllipticContact contact = dem::solve_elliptic(pair, gap);
    const dem::NormalSpring<double> spring = dem::Hertz::spring<double>(
        {}, {contact.prefactors.normal, contact.prefactors.tangential},
        overlap);
    raise(worst.gap, gap.a, exact("gap_a_1_m"));
    raise(worst.gap, gap.b, exact("gap_b_1_m"));
    raise(worst.axes, contact.major_axis * root, exact("major_axis_m"));
    raise(worst.axes, contact.minor_axis * root, exact("minor_axis_m"));
    raise(worst.force, spring.force, exact("force_N"));
    raise(worst.stiffness, spring.stiffness, exact("stiffness_N_m"));
    raise(worst.energy, spring.energy, exact("energy_J"));
    raise(worst.shear, contact.ks_major * root, exact("ks_major_N_m"));
    raise(worst.shear, contact.ks_minor * root, exact("ks_minor_N_m"));
    const dem::HertzPrefactors fit = dem::elliptic_table()(pair, gap);
    raise(worst.fit, fit.normal * overlap * root, exact("force_N"));
    raise(worst.shear_fit, fit.tangential * root,
          0.5 * (exact("ks_major_N_m") + exact("ks_minor_N_m")));
  }
  return worst;
}

// 1e-12: round-off of the bisection and of the table's sixteen digits. 1e-9:
// the promise of the fit.
std::vector<Row> elliptic_table_values()
{
  const ReferenceTable table("elliptic_contact.csv");
  const WorstErrors worst = worst_errors(table);
  const std::string of = " of " + std::to_string(table.size()) + " geometries";
  return {at_most("worst error of A and B" + of, "-", worst.gap, 1e-12),
          at_most("of the axes a, b", "-", worst.axes, 1e-12),
          at_most("of the force F", "-", worst.force, 1e-12),
          at_most("of the stiffness k_n", "-", worst.stiffness, 1e-12),
          at_most("of the energy E_e", "-", worst.energy, 1e-12),
          at_most("of k_s along both axes", "-", worst.shear, 1e-12),
          at_most("of F, production fit", "-", worst.fit, 1e-9),
          at_most("of k_s, production fit", "-", worst.shear_fit, 1e-9)};
}

// Four digits are printed, so half a unit of the last one is allowed (0.2223
// was rounded from 0.2222495).
std::vector<Row> published_ratios()
{
  const dem::PairElasticity pair = dem::mix(aggregate, aggregate);
  std::vector<Row> rows;
  for (const auto &[ratio, axes, force] :
       {std::array{1., 1., 1.}, std::array{1.5, 0.7633, 1.0034},
        std::array{2., 0.6306, 1.0100}, std::array{4., 0.3999, 1.0398},
        std::array{10., 0.2223, 1.1090}, std::array{25., 0.1259, 1.2120},
        std::array{100., 0.0550, 1.4351}})
  {
    const dem::GapCoefficients gap{50., 50. * ratio};
    const double sphere =
        4. / 3. * pair.modulus * std::sqrt(0.5 / std::sqrt(gap.a * gap.b));
    const std::string digits = std::to_string(ratio);
    const std::string of =
        " at B/A = " + digits.substr(0, digits.find('.') + 2);
    rows.push_back({"b/a" + of, "-", axes,
                    1. / dem::solve_elliptic(pair, gap).axis_ratio, 0.51e-4,
                    1.});
    rows.push_back({"F over the sphere's" + of, "-", force,
                    dem::elliptic_table()(pair, gap).normal / sphere, 0.5e-4,
                    1.});
  }
  return rows;
}

/// Largest relative error of the fit against the exact algorithm.
struct FitError
{
  double normal = 0., tangential = 0.;
};

FitError fit_error(const dem::PairElasticity &pair)
{
  FitError worst;
  constexpr int n = 4000;
  for (int k = 0; k <= n; ++k)
  {
    const dem::GapCoefficients gap{
        80., 80. * std::exp(k * std::log(1e4) / static_cast<double>(n))};
    const dem::HertzPrefactors exact =
        dem::solve_elliptic(pair, gap).prefactors;
    const dem::HertzPrefactors fit = dem::elliptic_table()(pair, gap);
    raise(worst.normal, fit.normal, exact.normal);
    raise(worst.tangential, fit.tangential, exact.tangential);
  }
  return worst;
}

// Chebyshev series of 20 terms leave 2.4e-11.
std::vector<Row> production_fit()
{
  FitError worst;
  for (const dem::Elasticity &other : {aggregate, steel, rigid})
  {
    const FitError here = fit_error(dem::mix(aggregate, other));
    worst.normal = std::max(worst.normal, here.normal);
    worst.tangential = std::max(worst.tangential, here.tangential);
  }
  return {at_most("worst error of C_H, B/A from 1 to 1e4", "-", worst.normal,
                  1e-10),
          at_most("worst error of k_s, B/A from 1 to 1e4", "-",
                  worst.tangential, 1e-10)};
}

// F = 4/3 E* sqrt(R) delta^(3/2), k_s = 8 G* sqrt(R delta); a line: the ellipse
// of B/A = 1e4 is the longest (stated). What that leaves of C_H at a hundred
// times the ratio is the exact C_H there.
std::vector<Row> limits()
{
  const dem::PairElasticity pair = dem::mix(aggregate, steel);
  const double radius = 0.007;
  const dem::GapCoefficients circle{0.5 / radius, 0.5 / radius};
  const dem::HertzPrefactors exact =
      dem::solve_elliptic(pair, circle).prefactors;
  const dem::HertzPrefactors fit = dem::elliptic_table()(pair, circle);
  const double modulus = 1. / (0.75 / (2. * 5e8) + 0.72 / (2. * 7.9e10));
  const double shear = 1. / (1.75 / 5e8 + 1.72 / 7.9e10);
  const double normal = 4. / 3. * modulus * std::sqrt(radius);
  const double tangential = 8. * shear * std::sqrt(radius);
  const dem::EllipticContact slit = dem::solve_elliptic(pair, {1e-2, 100.});
  const dem::HertzPrefactors end = dem::elliptic_table()(pair, {1e-2, 100.});
  const dem::HertzPrefactors beyond = dem::elliptic_table()(pair, {1e-4, 100.});
  const dem::NormalSpring<double> open =
      dem::Hertz::spring<double>({}, {normal, shear}, 0.);
  return {
      {"circle: C_H, exact algorithm", "N/m^1.5", normal, exact.normal, 1e-13},
      {"circle: C_H, production fit", "N/m^1.5", normal, fit.normal, 1e-9},
      {"circle: k_s / sqrt(delta), exact algorithm", "N/m^1.5", tangential,
       exact.tangential, 1e-13},
      {"circle: k_s / sqrt(delta), production fit", "N/m^1.5", tangential,
       fit.tangential, 1e-9},
      {"line: K(e) against ln(4 a/b), B/A = 1e4", "-",
       std::log(4. * slit.axis_ratio), slit.K, 1e-4},
      {"line: C_H at B/A = 1e4, production fit", "N/m^1.5",
       slit.prefactors.normal, end.normal, 1e-9},
      {"line: C_H beyond is that of B/A = 1e4", "N/m^1.5", end.normal,
       beyond.normal, 1e-14},
      at_most("no overlap: F, k_n, k_s, E_e together", "-",
              open.force + open.stiffness + open.shear_stiffness + open.energy,
              0.)};
}
} // namespace

Family laws()
{
  return {"laws",
          "Contact laws: elliptic Hertz, Mindlin (full stick), rolling, linear "
          "walls. Exact algorithm: bisection and arithmetic-geometric mean; "
          "production fit: Chebyshev series in ln(B/A).",
          {{"elliptic_values",
            "data/reference/elliptic_contact.csv: 40-digit arithmetic",
            elliptic_table_values},
           {"published_ratios",
            "Johnson (1985), 4.2: exact solution, printed to four digits",
            published_ratios},
           {"production_fit", "the exact algorithm (bisection, AGM)",
            production_fit},
           {"limits", "closed forms of circle and line", limits},
           {"pressure_integral",
            "Boussinesq integral of the elliptic pressure, no elliptic "
            "functions",
            pressure_integral},
           {"traction_integral", "Cerruti integral of the full-stick traction",
            traction_integral},
           {"shape_contacts",
            "regularised curvatures of closed forms, then the exact algorithm",
            shape_contacts},
           {"size_ratio", "F = 4/3 E* sqrt(R*) delta^1.5", size_ratio},
           {"springs",
            "k_s = 8 G* a, k_r = k_s R^2, c = 2 beta sqrt(m* k); k_n delta",
            springs}}};
}
} // namespace spall::verify
