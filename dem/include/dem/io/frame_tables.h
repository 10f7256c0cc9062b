#pragma once

#include <dem/engine.h>
#include <dem/io/table_file.h>

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace dem
{
/// Version of the layout of frame_tables(): docs/user/frame_tables.md. A column
/// that is added keeps it; one that is removed or changed raises it.
inline constexpr std::int64_t frame_tables_version = 1;

/// What a frame is of, besides its scene.
struct FrameDescription
{
  std::string title, kind; ///< of the case
  std::string program;     ///< version that writes it
  std::int64_t number = 0; ///< of the frame
  /// The series that particles share until they break, and their names.
  std::span<const std::shared_ptr<const Coefficients>> shapes = {};
  std::vector<std::string> shape_names = {};
  /// By the number of the plane; a plane without name is "plane_NUMBER".
  std::vector<std::string> plane_names = {};
};

/// Particles and contacts of a scene at one instant in double precision. Rows
/// are in the order of the ids, whatever the order of the scene. The engine has
/// all particles (Engine::gathered()).
TableFile frame_tables(const Engine &engine, const FrameDescription &frame);
} // namespace dem
