#pragma once

#include <dem/engine.h>
#include <dem/io/vtk_output.h>
#include <fem/membrane.h>

#include <filesystem>
#include <vector>

namespace spall
{
/// What a frame shows besides balls and contacts.
struct FrameParts
{
  const fem::Membrane *membrane = nullptr; ///< null: none
  bool has_surfaces = false;               ///< true surfaces of the stones
};

/// Writes frames/*_NNNNN.vtu of a run folder and run.pvd with all `entries`,
/// to which the new ones are added.
void write_frame(const std::filesystem::path &folder, const dem::Engine &engine,
                 const FrameParts &parts, int number,
                 std::vector<dem::FrameEntry> &entries);
} // namespace spall
