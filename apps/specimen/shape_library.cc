#include "specimen/shape_library.h"

#include "case/file.h"
#include "shape/loaded.h"

#include <filesystem>
#include <utility>

namespace spall
{
void ShapeLibrary::add(Series shape, const ShapeFile &file)
{
  all.push_back(std::move(shape));
  entries.push_back({std::filesystem::path(file.path).stem().string(),
                     file.source, file.licence});
}

ShapeLibrary load_shapes(const Case &parameters, const std::string &section,
                         const std::string &folder, int order)
{
  ShapeLibrary library;
  if (!folder.empty())
    for (const ShapeFile &shape :
         read_shapes(find_path(parameters, section, "shapes", folder)))
      library.add(load_with_warnings(shape, order), shape);
  return library;
}
} // namespace spall
