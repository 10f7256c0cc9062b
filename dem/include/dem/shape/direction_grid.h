#pragma once

#include <dem/vector.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace dem
{
/// Directions in rings at the polar angles (i + 1/2) pi / n_polar, at the
/// azimuths 2 pi k / n_azimuth.
struct DirectionGrid
{
  int n_polar = 0, n_azimuth = 0; ///< n_azimuth is even

  constexpr int size() const { return n_polar * n_azimuth; }
  Vec3 direction(int ring, int column) const;

  /// Number ring * n_azimuth + column of the node some rings on (-1 .. 1) and
  /// some columns on (-n_azimuth .. n_azimuth); beyond a pole the ring comes
  /// again from the other side.
  int neighbour(int ring, int column, int ring_step, int column_step) const;

  /// A direction between the nodes (ring, column) and (ring + 1, column + 1);
  /// ring is -1 .. n_polar - 1.
  struct Position
  {
    int ring = 0, column = 0;
    double down = 0., right = 0.; ///< part of the way, 0 .. 1
  };
  /// Of a direction that need not be unit, within 1e-5 rad.
  Position locate(const Vec3 &direction) const;
};

/// Values at the nodes of a grid, with a margin so that no position is a
/// special case.
class GridValues
{
public:
  GridValues() = default;
  GridValues(const DirectionGrid &over, const std::vector<double> &values);

  /// Rings from -1 to n_polar and columns to n_azimuth continue beyond the
  /// poles and round.
  double at(int ring, int column) const
  {
    return value[static_cast<std::size_t>((ring + 1) * (grid.n_azimuth + 1) +
                                          column)];
  }
  /// Row after row.
  const float *data() const { return value.data(); }

private:
  DirectionGrid grid;
  std::vector<float> value; ///< rows -1 .. n_polar of n_azimuth + 1
};
} // namespace dem
