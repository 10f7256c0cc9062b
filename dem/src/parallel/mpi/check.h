#pragma once

namespace dem
{
/// Throws std::runtime_error if a function of MPI failed: "<action>: <reason>".
void check_mpi(int code, const char *action);
/// The same for functions of Zoltan, which has printed the reason; its warnings
/// pass.
void check_zoltan(int code, const char *action);
/// MPI was started and has not ended.
bool mpi_is_running();
} // namespace dem
