#pragma once

/// Threads that wait for each other sleep after a short spin: on a busy machine
/// a waiting thread would take the time of the one it waits for.
///
/// OpenMP reads its wait policy from the environment when its library is
/// loaded. So the program starts itself again with the variable set, once, if a
/// run may have several threads and the user has set no policy. This happens
/// before the libraries are initialised, at the price of their relocation.
namespace spall
{
/// Turns of the loop in which a thread waits before it sleeps [-]. A turn takes
/// 15 to 50 ns: long enough for the serial parts of a step.
inline constexpr const char *spin_count = "GOMP_SPINCOUNT=4000";

/// Does nothing; a program that calls it has what is described above.
void apply_wait_policy();
} // namespace spall
