#include <dem/neighbor/schedule.h>

#include <algorithm>

namespace dem
{
void NeighborSchedule::advance(const StepSpeeds &fastest, double time_step,
                               bool has_deforming_lists)
{
  const double boundary = std::max(fastest.rigid, fastest.deforming);
  rigid_path += fastest.rigid * time_step;
  deforming_path += fastest.deforming * time_step;
  step_path = (fastest.moving + boundary) * time_step;
  path_length += step_path;
  const double surrounding = has_deforming_lists ? fastest.rigid : boundary;
  skin.left -= (fastest.closing + std::max(fastest.closing, surrounding) +
                fastest.cell) *
               time_step;
  deforming_left -= (fastest.closing + fastest.deforming) * time_step;
  paths.centres += (2. * fastest.moving + fastest.cell) * time_step;
  paths.gaps += (2. * fastest.closing + fastest.cell) * time_step;
  paths.cell += fastest.cell * time_step;
}

void NeighborSchedule::grow(double length)
{
  skin.left -= length;
  deforming_left -= length;
  paths.centres += length;
  paths.gaps += length;
}

void NeighborSchedule::lists_made()
{
  has_displaced = has_displaced_on_deforming = false;
  ++n_made;
}

void NeighborSchedule::deforming_lists_made()
{
  has_displaced_on_deforming = false;
  ++n_made;
}
} // namespace dem
