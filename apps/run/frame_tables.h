#pragma once

#include <dem/io/frame_tables.h>

#include <filesystem>

namespace spall
{
enum class FrameTablesForm
{
  none,
  hdf5 ///< a file with every frame
};

/// Tables besides the ParaView files, of every kind:
/// Case::own<FrameTablesParameters>().
struct FrameTablesParameters
{
  FrameTablesForm form = FrameTablesForm::none;
};

/// Writes frames/tables_NNNNN.h5 of a run folder: the tables of this frame.
/// Throws RunFailure or std::runtime_error.
void write_frame_tables(const std::filesystem::path &folder,
                        const dem::Engine &engine,
                        const dem::FrameDescription &frame);

/// Removes the file of this number that an earlier part of the run has left.
void remove_frame_tables(const std::filesystem::path &folder,
                         std::int64_t number);
} // namespace spall
