#include <dem/neighbor/schedule.h>

#include <algorithm>

namespace dem
{
void NeighborSchedule::advance(const StepSpeeds &fastest, double time_step,
                               bool has_lists_of_sheets)
{
  const double boundary = std::max(fastest.rigid, fastest.sheet);
  rigid_travelled += fastest.rigid * time_step;
  sheets_travelled += fastest.sheet * time_step;
  stride = (fastest.moving + boundary) * time_step;
  travelled += stride;
  const double surrounding = has_lists_of_sheets ? fastest.rigid : boundary;
  skin.left -= (fastest.closing + std::max(fastest.closing, surrounding) +
                fastest.cell) *
               time_step;
  sheets_left -= (fastest.closing + fastest.sheet) * time_step;
  travel.centres += (2. * fastest.moving + fastest.cell) * time_step;
  travel.gaps += (2. * fastest.closing + fastest.cell) * time_step;
  travel.cell += fastest.cell * time_step;
}

void NeighborSchedule::grow(double length)
{
  skin.left -= length;
  sheets_left -= length;
  travel.centres += length;
  travel.gaps += length;
}

void NeighborSchedule::lists_made()
{
  has_displaced = has_displaced_on_sheets = false;
  ++n_made;
}

void NeighborSchedule::lists_of_sheets_made()
{
  has_displaced_on_sheets = false;
  ++n_made;
}
} // namespace dem
