#include "rendering/render_ground.h"
#include "rendering/render_network.h"

#include <algorithm>

namespace spall
{
namespace
{
using Folders = std::span<const std::string>;

/// One colour scale for all runs, so that they compare.
void draw_specimens(Folders folders, std::span<RunPictures> pictures)
{
  std::vector<std::vector<SpecimenFiles>> specimens;
  double max_loss = 0.;
  for (const std::string &folder : folders)
  {
    specimens.push_back(find_specimens(folder));
    max_loss = std::max(max_loss, loss_scale(specimens.back()));
  }
  for (std::size_t k = 0; k < folders.size(); ++k)
    pictures[k].specimen =
        specimens[k].empty() ? Picture{"", "there is no frames/surfaces_*.vtu."}
                             : render_specimens(specimens[k], max_loss);
}

/// One scale of forces and one of bulges for all runs.
void draw_networks(Folders folders, std::span<RunPictures> pictures)
{
  std::vector<std::vector<NetworkFiles>> networks;
  double max_force = 0., max_bulge = 0.;
  for (const std::string &folder : folders)
  {
    networks.push_back(find_networks(folder));
    max_force = std::max(max_force, force_scale(networks.back()));
    max_bulge = std::max(max_bulge, bulge_scale(networks.back()));
  }
  for (std::size_t k = 0; k < folders.size(); ++k)
    pictures[k].network =
        networks[k].empty() ? Picture{"", "there is no frames/contacts_*.vtu."}
                            : render_network(networks[k], max_force, max_bulge);
}

/// One scale of settlements for all runs.
void draw_grounds(Folders folders, std::span<RunPictures> pictures)
{
  std::vector<std::vector<GroundFiles>> grounds;
  double max_settlement = 0.;
  for (const std::string &folder : folders)
  {
    grounds.push_back(find_grounds(folder));
    max_settlement = std::max(max_settlement, settlement_scale(grounds.back()));
  }
  for (std::size_t k = 0; k < folders.size(); ++k)
    if (!grounds[k].empty())
      pictures[k].ground = render_ground(grounds[k], max_settlement);
}
} // namespace

std::vector<RunPictures> draw_pictures(std::span<const std::string> folders)
{
  std::vector<RunPictures> pictures(folders.size());
  draw_specimens(folders, pictures);
  draw_networks(folders, pictures);
  draw_grounds(folders, pictures);
  return pictures;
}
} // namespace spall
