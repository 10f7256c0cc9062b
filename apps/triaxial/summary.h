#pragma once

#include "triaxial/cycles.h"

#include <map>
#include <string>

namespace spall
{
/// Clocks that the recorder holds.
struct RecordedTime
{
  double total = 0., output = 0.; ///< since the start of the program [s]
  double preparation = 0.;        ///< 0 if it was not part of this program run
  double preparation_processor = 0.; ///< likewise, of all threads
  dem::EngineClock preparation_clock;
};

/// Wall-clock by phase [s]; the phases of stepping are those after the
/// preparation. Adds what earlier programs of the same run spent.
std::map<std::string, double>
wall_clock(const Triaxial &test, const RecordedTime &recorded,
           const std::map<std::string, double> &before);

/// What the recorder knows at the end of a run.
struct RunRecord
{
  Sample start, end;             ///< of loading
  double worst_gain = 0.;        ///< of the exchange [-]
  double peak_axial_stress = 0.; ///< while loading [Pa]
  int threads = 1;
  double gradation_error = 0.; ///< obtained less asked mass, at most [-]
  std::map<std::string, double> seconds;
};

/// summary.json.
std::string summary_text(const Case &parameters, const Triaxial &test,
                         const RunRecord &record, const CycleRecorder &cycles);
} // namespace spall
