#pragma once

namespace dem
{
/// The stress-strain loop of one load cycle, point by point: deviator stress q
/// over axial strain, compression positive. Plain data: a checkpoint takes it
/// as it is.
class Hysteresis
{
public:
  /// The first point of a cycle, and every further one up to its end.
  void begin(double strain, double stress);
  void add(double strain, double stress);

  /// Largest strain less the smallest that came after it [-].
  double resilient_strain() const { return largest_strain - strain_since; }
  double cyclic_stress() const
  {
    return largest_stress - least_stress;
  } ///< [Pa]
  /// Their quotient M_R [Pa]; NaN without strain.
  double resilient_modulus() const;
  /// Area of the loop, closed by a straight line, over 4 pi W_s (ASTM D3999)
  /// with W_s = q_c eps_r / 8, the energy of the single amplitudes q_c / 2 and
  /// eps_r / 2 [-]; NaN without strain. tan(phi / 2) where the strain lags by
  /// phi.
  double damping_ratio() const;

private:
  struct Point
  {
    double strain = 0., stress = 0.; ///< [-], [Pa]
  };
  /// Area under the line from one point to another [J/m^3].
  static double work(const Point &from, const Point &to);

  Point first, last;
  double area = 0.; ///< under the points so far [J/m^3]
  double largest_strain = 0., strain_since = 0.; ///< smallest since [-]
  double largest_stress = 0., least_stress = 0.; ///< [Pa]
};
} // namespace dem
