#include "expansion_table.h"

#include "zonal_table.h"

namespace dem::kernel
{
static_assert(top_order == max_order);

namespace
{
void fill_order(ExpansionTable &table, int m)
{
  const detail::ZonalTable &zonal = detail::zonal_table();
  table.first[m][m] = 1.;
  table.scale[m][m] = zonal.diagonal[m];
  for (int n = m + 1; n <= max_order; ++n)
  {
    table.scale[n][m] = zonal.rise[n][m] * table.scale[n - 1][m];
    if (n > m + 1)
      table.fall[n][m] =
          zonal.fall[n][m] * table.scale[n - 2][m] / table.scale[n][m];
  }
  table.m[m] = m;
  table.m_times[m] = m * (m - 1.);
}

ExpansionTable make_table()
{
  ExpansionTable table;
  for (int m = 0; m <= max_order; ++m)
    fill_order(table, m);
  return table;
}
} // namespace

const ExpansionTable &expansion_table()
{
  static const ExpansionTable table = make_table();
  return table;
}
} // namespace dem::kernel
