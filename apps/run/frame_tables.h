#pragma once

#include <dem/io/frame_tables.h>

#include <filesystem>

namespace spall
{
/// Writes frames/tables_NNNNN.h5 of a run folder: the tables of this frame.
/// Throws RunFailure or std::runtime_error.
void write_frame_tables(const std::filesystem::path &folder,
                        const dem::Engine &engine,
                        const dem::FrameDescription &frame);

/// Removes the file of this number that an earlier part of the run has left.
void remove_frame_tables(const std::filesystem::path &folder,
                         std::int64_t number);
} // namespace spall
