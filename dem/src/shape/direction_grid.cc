#include <dem/shape/direction_grid.h>

namespace dem
{
namespace
{
/// The angle of (x, y) in [0, 2 pi), within 1e-5 rad (Abramowitz & Stegun
/// 4.4.49); 0 at the origin.
double angle_of(double x, double y)
{
  const double u = std::abs(x), v = std::abs(y);
  const double larger = std::max(u, v);
  const double t = larger > 0. ? std::min(u, v) / larger : 0., z = t * t;
  double angle =
      t *
      (0.9998660 +
       z * (-0.3302995 + z * (0.1801410 + z * (-0.0851330 + z * 0.0208351))));
  angle = v > u ? 0.5 * std::numbers::pi - angle : angle;
  angle = x < 0. ? std::numbers::pi - angle : angle;
  return y < 0. ? 2. * std::numbers::pi - angle : angle;
}
} // namespace

Vec3 DirectionGrid::direction(int ring, int column) const
{
  const double polar = (ring + 0.5) * std::numbers::pi / n_polar;
  const double azimuth = 2. * std::numbers::pi * column / n_azimuth;
  return {std::sin(polar) * std::cos(azimuth),
          std::sin(polar) * std::sin(azimuth), std::cos(polar)};
}

int DirectionGrid::neighbour(int ring, int column, int ring_step,
                             int column_step) const
{
  int to = ring + ring_step, shift = 0;
  if (to < 0 || to >= n_polar)
  {
    to = to < 0 ? -1 - to : 2 * n_polar - 1 - to;
    shift = n_azimuth / 2;
  }
  return to * n_azimuth +
         (column + column_step + shift + n_azimuth) % n_azimuth;
}

DirectionGrid::Position DirectionGrid::locate(const Vec3 &direction) const
{
  const double polar_step = std::numbers::pi / n_polar;
  const double aside_square =
      direction.x() * direction.x() + direction.y() * direction.y();
  // `down` counts from ring -1 on.
  const double down =
      angle_of(direction.z(), std::sqrt(aside_square)) / polar_step + 0.5;
  const double right = angle_of(direction.x(), direction.y()) * n_azimuth /
                       (2. * std::numbers::pi);
  Position position;
  // The limit goes first: std::min then takes it where there is no number.
  position.ring = static_cast<int>(std::min<double>(n_polar, down)) - 1;
  position.column = static_cast<int>(std::min<double>(n_azimuth - 1, right));
  position.down = down - (position.ring + 1);
  position.right = right - position.column;
  return position;
}

GridValues::GridValues(const DirectionGrid &over,
                       const std::vector<double> &values)
    : grid(over)
{
  for (int i = -1; i <= grid.n_polar; ++i)
    for (int k = 0; k <= grid.n_azimuth; ++k)
    {
      const int inside = std::clamp(i, 0, grid.n_polar - 1);
      value.push_back(static_cast<float>(values[static_cast<std::size_t>(
          grid.neighbour(inside, k % grid.n_azimuth, i - inside, 0))]));
    }
}
} // namespace dem
