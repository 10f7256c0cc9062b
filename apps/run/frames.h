#pragma once

#include <dem/engine.h>
#include <dem/io/vtk_output.h>
#include <fem/membrane.h>

#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace spall
{
/// A body of its own file NAME_NNNNN.vtu.
struct FrameBody
{
  const char *name;
  std::function<void(std::ostream &)> write;
};

/// What a frame shows besides equivalent spheres and contacts.
struct FrameParts
{
  const fem::Membrane *membrane = nullptr; ///< null: none
  bool has_surfaces = false;               ///< true surfaces of the particles
  std::vector<FrameBody> bodies = {};
};

/// Writes frames/*_NNNNN.vtu of a run folder and run.pvd with all `entries`,
/// to which the new ones are added; with the first of them view.py, which
/// shows them in ParaView.
void write_frame(const std::filesystem::path &folder, const dem::Engine &engine,
                 const FrameParts &parts, int number,
                 std::vector<dem::FrameEntry> &entries);

/// The same of a scene over ranks, without a copy of the whole: each rank
/// writes its particles and contacts, frames/*_NNNNN_RRRR.vtu, and the first
/// one the indices of the pieces, *_NNNNN.pvtu, and all else. Collective; what
/// a rank throws all throw.
void write_frame_in_pieces(const std::filesystem::path &folder,
                           const dem::Engine &engine, const FrameParts &parts,
                           int number, std::vector<dem::FrameEntry> &entries);

/// Those whose files are still there: frames may be deleted between two parts
/// of a run.
std::vector<dem::FrameEntry>
present_frames(const std::filesystem::path &folder,
               std::vector<dem::FrameEntry> entries);
} // namespace spall
