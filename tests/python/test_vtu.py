"""Frames are read as VTK reads them; no program is needed."""
import itertools

import numpy as np

import spall
from samples import InFolder, needs
from spall.mesh import ply_bytes, signed_volume, write_surfaces

ASCII = """<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">
<UnstructuredGrid><Piece NumberOfPoints="2" NumberOfCells="1">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">
0 0 0 1 0 0.5</DataArray></Points>
<Cells><DataArray type="Int32" Name="connectivity" format="ascii">0 1
</DataArray><DataArray type="Int32" Name="offsets" format="ascii">2
</DataArray><DataArray type="UInt8" Name="types" format="ascii">3
</DataArray></Cells>
<PointData><DataArray type="Float32" Name="a_m" format="ascii">1 2</DataArray>
</PointData></Piece></UnstructuredGrid></VTKFile>
"""


def tetrahedron():
    """Points and triangles, counter-clockwise seen from outside."""
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
                      dtype=float)
    return points, np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])


def tetrahedron_grid():
    points, triangles = tetrahedron()
    n = len(triangles)
    return spall.Grid(points, triangles.ravel(), np.arange(1, n + 1) * 3,
                      np.full(n, 5), {}, {"id": np.arange(n),
                                          "loss_1": np.full(n, 0.25)})


class Grids(InFolder):
    def test_text(self):
        grid = spall.read_vtu(self.file("a.vtu", ASCII))
        np.testing.assert_array_equal(grid.points, [[0, 0, 0], [1, 0, 0.5]])
        np.testing.assert_array_equal(grid.cells(2), [[0, 1]])
        np.testing.assert_array_equal(grid.point_data["a_m"], [1, 2])

    def test_several_pieces(self):
        start, end = ASCII.index("<Piece"), ASCII.index("</Unstructured")
        twice = ASCII[:end] + ASCII[start:end] + ASCII[end:]
        grid = spall.read_vtu(self.file("a.vtu", twice))
        np.testing.assert_array_equal(grid.cells(2), [[0, 1], [2, 3]])
        np.testing.assert_array_equal(grid.point_data["a_m"], [1, 2, 1, 2])

    def test_pieces_of_an_index(self):
        for name in ("a_0000.vtu", "a_0001.vtu"):
            self.file(name, ASCII)
        grid = spall.read_vtu(self.file("a.pvtu", (
            '<VTKFile type="PUnstructuredGrid"><PUnstructuredGrid>'
            '<Piece Source="a_0000.vtu"/><Piece Source="a_0001.vtu"/>'
            '</PUnstructuredGrid></VTKFile>')))
        np.testing.assert_array_equal(grid.cells(2), [[0, 1], [2, 3]])
        np.testing.assert_array_equal(grid.point_data["a_m"], [1, 2, 1, 2])
        with self.assertRaisesRegex(spall.InputError, "no index"):
            spall.read_vtu(self.file("b.pvtu", "nothing"))
        with self.assertRaisesRegex(spall.InputError, "has no piece"):
            spall.read_vtu(self.file("b.pvtu", "<VTKFile/>"))

    def test_other_files_are_refused(self):
        for text, what in (("nothing", "no VTK XML"),
                           (ASCII.replace("Unstructured", "Poly"), "PolyGrid"),
                           (ASCII.replace("byte_order",
                                          'compressor="vtkLZ4" byte_order'),
                            "vtkLZ4")):
            with self.assertRaisesRegex(spall.InputError, what):
                spall.read_vtu(self.file("a.vtu", text))

    @needs("vtkmodules")
    def test_every_form_that_vtk_writes(self):
        from vtkmodules.util.numpy_support import numpy_to_vtk
        from vtkmodules.vtkCommonDataModel import VTK_LINE, vtkUnstructuredGrid
        from vtkmodules.vtkCommonCore import vtkPoints
        from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

        random = np.random.default_rng(1)
        n = 20000  # more than a block of compressed data
        points = random.random((n, 3)).astype(np.float32)
        grid, nodes = vtkUnstructuredGrid(), vtkPoints()
        nodes.SetData(numpy_to_vtk(points, deep=True))
        grid.SetPoints(nodes)
        for k in range(0, n, 2):
            grid.InsertNextCell(VTK_LINE, 2, (k, k + 1))
        fields = {"f": random.random(n), "v": random.random((n, 3)),
                  "id": np.arange(n)}
        for name, values in fields.items():
            array = numpy_to_vtk(values, deep=True)
            array.SetName(name)
            grid.GetPointData().AddArray(array)
        for mode, encoded, zipped, wide in itertools.product(
                ("Ascii", "Binary", "Appended"), (0, 1), (0, 1), (0, 1)):
            writer = vtkXMLUnstructuredGridWriter()
            path = self.folder / "a.vtu"
            writer.SetFileName(str(path))
            writer.SetInputData(grid)
            getattr(writer, f"SetDataModeTo{mode}")()
            writer.SetEncodeAppendedData(encoded)
            writer.SetCompressorTypeToZLib() if zipped else \
                writer.SetCompressorTypeToNone()
            writer.SetHeaderType(64 if wide else 32)
            writer.Write()
            with self.subTest(mode=mode, encoded=encoded, zipped=zipped,
                              wide=wide):
                read = spall.read_vtu(path)
                # Text has fewer digits than a double.
                check = np.testing.assert_array_equal if mode != "Ascii" else \
                    lambda a, b: np.testing.assert_allclose(a, b, rtol=1e-5)
                check(read.points, points)
                np.testing.assert_array_equal(
                    read.cells(2), np.arange(n).reshape(-1, 2))
                for name, values in fields.items():
                    check(read.point_data[name], values)


class Meshes(InFolder):
    def test_volume(self):
        self.assertAlmostEqual(signed_volume(*tetrahedron()), 1 / 6)

    def test_stl(self):
        write_surfaces(tetrahedron_grid(), self.folder / "a.stl", 1000.0)
        data = (self.folder / "a.stl").read_bytes()
        self.assertEqual(len(data), 84 + 4 * 50)
        first = np.frombuffer(data, "<f4", 12, 84).reshape(4, 3)
        np.testing.assert_array_equal(first, [[0, 0, -1], [0, 0, 0],
                                              [0, 1000, 0], [1000, 0, 0]])

    def test_ply(self):
        points, triangles = tetrahedron()
        data = ply_bytes(points.astype("<f4"), triangles,
                         tetrahedron_grid().cell_data)
        head, _, body = data.partition(b"end_header\n")
        self.assertIn(b"element vertex 4\n", head)
        self.assertIn(b"property int id\nproperty float loss_1", head)
        self.assertEqual(len(body), 4 * 12 + 4 * (1 + 12 + 8))
        last = np.frombuffer(body[-20:-4], "<i4")
        np.testing.assert_array_equal(last, [1, 2, 3, 3])

    def test_faults(self):
        for name, scale, what in (("a.obj", 1.0, "ends in .stl or .ply"),
                                  ("a.stl", 0.0, "must be above 0")):
            with self.assertRaisesRegex(spall.InputError, what):
                write_surfaces(tetrahedron_grid(), self.folder / name, scale)

    @needs("vtkmodules")
    def test_vtk_reads_them(self):
        from vtkmodules.vtkFiltersCore import vtkMassProperties
        from vtkmodules.vtkIOGeometry import vtkSTLReader
        from vtkmodules.vtkIOPLY import vtkPLYReader

        for name, reader in (("a.stl", vtkSTLReader()),
                             ("a.ply", vtkPLYReader())):
            write_surfaces(tetrahedron_grid(), self.folder / name, 2.0)
            reader.SetFileName(str(self.folder / name))
            mass = vtkMassProperties()
            mass.SetInputConnection(reader.GetOutputPort())
            self.assertAlmostEqual(mass.GetVolume(), 8 / 6, places=6)
