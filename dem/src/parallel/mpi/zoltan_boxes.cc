#include "zoltan_boxes.h"

#include "check.h"

#include <dem/assert.h>

#include <array>
#include <utility>

namespace dem
{
namespace
{
struct WeightedPoints
{
  std::span<const Vec3> points; ///< [m]
  std::span<const float> weights;
};

int count_points(void *data, int *code)
{
  *code = ZOLTAN_OK;
  return static_cast<int>(static_cast<WeightedPoints *>(data)->points.size());
}

// Ids are rows of the list: they need not differ between ranks, as no list
// of points is asked for.
void list_points(void *data, int, int, ZOLTAN_ID_PTR id, ZOLTAN_ID_PTR, int,
                 float *weight, int *code)
{
  const auto &given = *static_cast<WeightedPoints *>(data);
  for (std::size_t k = 0; k < given.points.size(); ++k)
  {
    id[k] = static_cast<ZOLTAN_ID_TYPE>(k);
    weight[k] = given.weights[k];
  }
  *code = ZOLTAN_OK;
}

int count_coordinates(void *, int *code)
{
  *code = ZOLTAN_OK;
  return 3;
}

void list_coordinates(void *data, int, int, int n, ZOLTAN_ID_PTR id,
                      ZOLTAN_ID_PTR, int, double *coordinates, int *code)
{
  const auto &given = *static_cast<WeightedPoints *>(data);
  for (std::ptrdiff_t k = 0; k < n; ++k)
    Eigen::Map<Vec3>(coordinates + 3 * k) = given.points[id[k]];
  *code = ZOLTAN_OK;
}

void set_parameters(Zoltan_Struct *zoltan)
{
  constexpr std::array<std::pair<const char *, const char *>, 11> parameters = {
      {{"DEBUG_LEVEL", "0"},
       {"LB_METHOD", "RCB"},
       {"IMBALANCE_TOL", "1.01"},
       {"NUM_GID_ENTRIES", "1"},
       {"NUM_LID_ENTRIES", "0"},
       {"OBJ_WEIGHT_DIM", "1"},
       {"OBJ_WEIGHTS_COMPARABLE", "1"}, // takes the weights as they are
       {"RETURN_LISTS", "NONE"},
       {"KEEP_CUTS", "1"},
       // A point lies in the box that owner() finds, also on a cut.
       {"RCB_RECTILINEAR_BLOCKS", "1"},
       {"AVERAGE_CUTS", "1"}}};
  for (const auto &[name, value] : parameters)
    check_zoltan(Zoltan_Set_Param(zoltan, name, value), name);
}

void set_callbacks(Zoltan_Struct *zoltan, WeightedPoints &given)
{
  check_zoltan(Zoltan_Set_Num_Obj_Fn(zoltan, count_points, &given),
               "take the number of points");
  check_zoltan(Zoltan_Set_Obj_List_Fn(zoltan, list_points, &given),
               "take the list of points");
  check_zoltan(Zoltan_Set_Num_Geom_Fn(zoltan, count_coordinates, &given),
               "take the number of coordinates");
  check_zoltan(Zoltan_Set_Geom_Multi_Fn(zoltan, list_coordinates, &given),
               "take coordinates");
}

/// Points that change their rank, as Zoltan lists them. None are asked for.
struct ZoltanList
{
  ZoltanList() = default;
  ~ZoltanList() { Zoltan_LB_Free_Part(&global, &local, &ranks, &parts); }
  ZoltanList(const ZoltanList &) = delete;
  ZoltanList &operator=(const ZoltanList &) = delete;

  int n = 0;
  ZOLTAN_ID_PTR global = nullptr, local = nullptr;
  int *ranks = nullptr, *parts = nullptr;
};
} // namespace

void ZoltanBoxes::Destroy::operator()(Zoltan_Struct *zoltan) const
{
  int is_over = 0;
  if (MPI_Finalized(&is_over) == MPI_SUCCESS && !is_over)
    Zoltan_Destroy(&zoltan);
}

ZoltanBoxes::ZoltanBoxes(const Communicator &communicator)
    : n_ranks(communicator.size()), zoltan(Zoltan_Create(communicator.get()))
{
  check_zoltan(zoltan ? ZOLTAN_OK : ZOLTAN_FATAL, "make its data");
  set_parameters(zoltan.get());
}

void ZoltanBoxes::divide(std::span<const Vec3> points,
                         std::span<const float> weights)
{
  DEM_ASSERT(points.size() == weights.size());
  WeightedPoints given{points, weights};
  set_callbacks(zoltan.get(), given);
  ZoltanList imported, exported;
  int has_changed = 0, n_global = 0, n_local = 0;
  check_zoltan(Zoltan_LB_Partition(
                   zoltan.get(), &has_changed, &n_global, &n_local, &imported.n,
                   &imported.global, &imported.local, &imported.ranks,
                   &imported.parts, &exported.n, &exported.global,
                   &exported.local, &exported.ranks, &exported.parts),
               "divide space");
  is_divided = true;
}

int ZoltanBoxes::owner(const Vec3 &point) const
{
  if (!is_divided)
    return 0;
  Vec3 coordinates = point;
  int rank = 0, part = 0;
  check_zoltan(
      Zoltan_LB_Point_PP_Assign(zoltan.get(), coordinates.data(), &rank, &part),
      "find the box of a point");
  return rank;
}

void ZoltanBoxes::owners(const Vec3 &lower, const Vec3 &upper,
                         std::vector<int> &ranks) const
{
  if (!is_divided)
  {
    ranks.assign(1, 0);
    return;
  }
  ranks.resize(static_cast<std::size_t>(n_ranks));
  int n = 0, n_parts = 0;
  check_zoltan(Zoltan_LB_Box_PP_Assign(
                   zoltan.get(), lower.x(), lower.y(), lower.z(), upper.x(),
                   upper.y(), upper.z(), ranks.data(), &n, nullptr, &n_parts),
               "find the boxes that meet a box");
  ranks.resize(static_cast<std::size_t>(n));
}
} // namespace dem
