#include "sheet_material.h"

#include <algorithm>
#include <cmath>

namespace fem
{
namespace
{
double determinant(const Symmetric &c)
{
  return c.xx * c.yy - c.xy * c.xy;
}

Symmetric kirchhoff_stress(const SheetMaterial &m, const Symmetric &e)
{
  return {m.stiffness * (e.xx + m.poisson_ratio * e.yy),
          m.stiffness * (e.yy + m.poisson_ratio * e.xx),
          m.stiffness * (1. - m.poisson_ratio) * e.xy};
}

/// Of the law with its tension, whether it is in compression or not.
Symmetric law_stress(const SheetMaterial &m, const Symmetric &e)
{
  Symmetric s = kirchhoff_stress(m, e);
  if (m.shear > 0.)
  {
    const Symmetric c = right_cauchy_green(e);
    const double squared = 1. / (determinant(c) * determinant(c));
    s = {m.shear * (1. - c.yy * squared), m.shear * (1. - c.xx * squared),
         m.shear * c.xy * squared};
  }
  return {s.xx + m.tension, s.yy + m.tension, s.xy};
}

Symmetric law_change(const SheetMaterial &m, const Symmetric &e,
                     const Symmetric &de)
{
  if (!(m.shear > 0.))
    return kirchhoff_stress(m, de);
  const Symmetric c = right_cauchy_green(e);
  const double det = determinant(c), squared = 1. / (det * det);
  const double growth =
      2. * (c.yy * de.xx + c.xx * de.yy - 2. * c.xy * de.xy) / det;
  const double factor = 2. * m.shear * squared;
  return {factor * (c.yy * growth - de.yy), factor * (c.xx * growth - de.xx),
          factor * (de.xy - c.xy * growth)};
}

double law_energy(const SheetMaterial &m, const Symmetric &e)
{
  const double start = m.tension * (e.xx + e.yy);
  if (!(m.shear > 0.))
    return start + 0.5 * contract(kirchhoff_stress(m, e), e);
  const Symmetric c = right_cauchy_green(e);
  return start + 0.5 * m.shear * (c.xx + c.yy + 1. / determinant(c) - 3.);
}

double least_principal(const Symmetric &s)
{
  return 0.5 * (s.xx + s.yy) - std::hypot(0.5 * (s.xx - s.yy), s.xy);
}

/// Principal values and axes of a strain: C1 = 1 + 2 (middle + radius).
struct Principal
{
  double major;        ///< C1 [-]
  double spread;       ///< C1 - C2 [-]
  double cosine, sine; ///< of twice the angle of the major axis [-]
};

Principal principal(const Symmetric &e)
{
  const double half = 0.5 * (e.xx - e.yy), radius = std::hypot(half, e.xy);
  const double scale = radius > 0. ? 1. / radius : 0.;
  return {1. + e.xx + e.yy + 2. * radius, 4. * radius, half * scale,
          e.xy * scale};
}

/// At C1 not below that where it is slack: stress, its derivative with C1 times
/// two, energy.
struct LineState
{
  double stress, slope, energy; ///< [N/m], [N/m], [J/m^2]
};

LineState along(const TensionLine &line, double major)
{
  const double c = std::max(major, line.slack), y = line.modulus;
  if (!line.is_neo_hookean)
  {
    const double e = 0.5 * (c - 1.);
    return {y * e + line.start, y,
            (0.5 * y * e + line.start) * e + line.energy};
  }
  const double k = line.start, ratio = std::sqrt(k / c);
  return {y * (k - ratio / c), 3. * y * ratio / (c * c),
          0.5 * y * (k * c + 2. * ratio - 3.) + line.energy};
}

/// (1 - r) a + r b
Symmetric blend(const SheetMaterial &m, const Symmetric &a, const Symmetric &b)
{
  const double r = m.residual;
  return {(1. - r) * a.xx + r * b.xx, (1. - r) * a.yy + r * b.yy,
          (1. - r) * a.xy + r * b.xy};
}

/// A tensor with 11 and 12 in principal axes.
Symmetric turned(const Principal &axes, double along_major, double beside)
{
  return {0.5 * along_major * (1. + axes.cosine) - beside * axes.sine,
          0.5 * along_major * (1. - axes.cosine) + beside * axes.sine,
          0.5 * along_major * axes.sine + beside * axes.cosine};
}

/// Where it is slack nothing changes; else the axes turn, too.
Symmetric wrinkled_change(const SheetMaterial &m, const Symmetric &e,
                          const Symmetric &de)
{
  const Principal axes = principal(e);
  const TensionLine line = tension_line(m);
  if (axes.major <= line.slack)
    return {0., 0., 0.};
  const LineState now = along(line, axes.major);
  const double half = 0.5 * (de.xx - de.yy);
  const double stretch =
      0.5 * (de.xx + de.yy) + half * axes.cosine + de.xy * axes.sine;
  const double shear = de.xy * axes.cosine - half * axes.sine;
  return turned(axes, now.slope * stretch,
                2. * now.stress / axes.spread * shear);
}
} // namespace

TensionLine tension_line(const SheetMaterial &m)
{
  TensionLine line;
  const double t = m.tension;
  line.is_neo_hookean = m.shear > 0.;
  if (line.is_neo_hookean)
  {
    line.modulus = m.shear;
    line.start = 1. + t / m.shear;
    line.energy = -t;
    line.slack = 1. / std::cbrt(line.start);
    return line;
  }
  const double nu = m.poisson_ratio;
  line.modulus = m.stiffness * (1. - nu * nu);
  line.start = t * (1. - nu);
  line.energy = -0.5 * t * t / m.stiffness;
  line.slack = 1. - 2. * line.start / line.modulus;
  return line;
}

Symmetric right_cauchy_green(const Symmetric &e)
{
  return {1. + 2. * e.xx, 1. + 2. * e.yy, 2. * e.xy};
}

double contract(const Symmetric &a, const Symmetric &b)
{
  return a.xx * b.xx + a.yy * b.yy + 2. * a.xy * b.xy;
}

bool is_wrinkled(const SheetMaterial &m, const Symmetric &e)
{
  return !(least_principal(law_stress(m, e)) > 0.);
}

Symmetric stress(const SheetMaterial &m, const Symmetric &e)
{
  const Symmetric law = law_stress(m, e);
  if (!m.has_wrinkles || least_principal(law) > 0.)
    return law;
  const Principal axes = principal(e);
  return blend(m, turned(axes, along(tension_line(m), axes.major).stress, 0.),
               law);
}

Symmetric stress_change(const SheetMaterial &m, const Symmetric &e,
                        const Symmetric &de)
{
  const Symmetric law = law_change(m, e, de);
  if (!m.has_wrinkles || !is_wrinkled(m, e))
    return law;
  return blend(m, wrinkled_change(m, e, de), law);
}

double energy_density(const SheetMaterial &m, const Symmetric &e)
{
  const double law = law_energy(m, e);
  if (!m.has_wrinkles || !is_wrinkled(m, e))
    return law;
  return std::lerp(along(tension_line(m), principal(e).major).energy, law,
                   m.residual);
}
} // namespace fem
