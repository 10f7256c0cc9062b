#pragma once

#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

#include <map>
#include <span>
#include <string>
#include <vector>

namespace spall
{
/// Files of one instant. An empty sheet: there is none.
struct SpecimenFiles
{
  std::string title, surfaces, sheet; ///< membrane, plate or drum
};

/// First and last frame with surfaces of a run folder; none, one or two.
std::vector<SpecimenFiles> find_specimens(const std::string &folder);

/// Upper end of the colour bar: the loss that 98 % of the particles stay below,
/// rounded up, in the last of these frames [-].
double loss_scale(std::span<const SpecimenFiles> specimens);

/// NAME_00012.vtu, or the index NAME_00012.pvtu of pieces, in the frames of a
/// run folder by number.
std::map<int, std::string> frames_of(const std::string &folder,
                                     const std::string &name);

/// When they were written, by number [s]; empty without run.pvd.
std::map<int, double> frame_times(const std::string &folder);

/// The cells of a .vtu or .pvtu file with their data; empty if it cannot be
/// read.
void read_grid(const std::string &path, vtkUnstructuredGrid *grid);

/// Faces, or lines, of such a file with their data; none if it cannot be read.
vtkNew<vtkPolyData> read_faces(const std::string &path);
vtkNew<vtkPolyData> read_lines(const std::string &path);
} // namespace spall
