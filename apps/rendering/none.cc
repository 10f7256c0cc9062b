// All that is compiled of this folder where SPALL_RENDERING is off.
#include "report/pictures.h"

namespace spall
{
std::vector<RunPictures> draw_pictures(std::span<const std::string> folders)
{
  const Picture none{
      "", "this program was built without pictures (SPALL_RENDERING = OFF)."};
  return std::vector<RunPictures>(folders.size(), {none, none, none});
}
} // namespace spall
