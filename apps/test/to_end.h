#pragma once

#include "case/parameter.h"
#include "errors.h"
#include "run/options.h"
#include "test/recorder.h"

#include <coupling/exchange.h>

#include <string>

namespace spall
{
/// What the program says of a contact that is too deep: limit and remedies.
inline std::string overlap_text(const dem::OverlapStop &stop, const Test &test)
{
  return std::string(stop.what()) + ", above Contact/overlap_stop = " +
         number_text(test.engine().parameters().geometry.overlap.stop) +
         ": stiffer contacts (Particle/shear_modulus, Wall/normal_stiffness), "
         "a lower load or a shorter step";
}

/// Calls `loop`, which ends when the test is done or a stop was requested.
/// Throws RunFailure with the last checkpoint if it fails or was stopped; of a
/// guard also with that of this moment, which `recorder` stores.
template <class Loop>
void run_to_end(Test &test, Recorder &recorder, const Loop &loop)
{
  const auto last = [&recorder]
  {
    const std::string checkpoint = recorder.last_checkpoint();
    return checkpoint.empty() ? "none" : checkpoint;
  };
  try
  {
    loop();
  }
  catch (const coupling::GuardStop &stop)
  {
    const std::string before = last(), now = recorder.save_stopped(test);
    throw RunFailure(std::string(stop.what()) +
                     "; checkpoint of this moment: " + now +
                     "; last one before: " + before);
  }
  catch (const dem::OverlapStop &stop)
  {
    throw RunFailure(overlap_text(stop, test) + "; last checkpoint: " + last());
  }
  catch (const std::exception &error)
  {
    throw RunFailure(std::string(error.what()) +
                     "; last checkpoint: " + last());
  }
  if (is_stop_asked())
    throw RunFailure("stopped at step " +
                     std::to_string(test.engine().n_steps()) +
                     ", continue with --resume; last checkpoint: " + last());
}
} // namespace spall
