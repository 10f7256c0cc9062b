#pragma once

#include <span>
#include <string>
#include <vector>

namespace spall
{
struct Picture
{
  std::string png;     ///< the file as bytes; empty: not drawn
  std::string problem; ///< why, one sentence
  int width = 0;       ///< [px]
};

/// Pictures of one run.
struct RunPictures
{
  Picture specimen; ///< particles with their surfaces
  Picture network;  ///< contact forces, bulge of the membrane
  Picture ground;   ///< settled subgrade
};

/// Pictures of each run folder, with the same colour scales for all runs. A
/// program that is built without SPALL_RENDERING draws none, and says so in
/// `problem`.
std::vector<RunPictures> draw_pictures(std::span<const std::string> folders);
} // namespace spall
