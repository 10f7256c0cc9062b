"""Frames of a run: states at instants, as files for ParaView."""
from __future__ import annotations

import dataclasses
import pathlib
import re
from typing import Any
from xml.etree import ElementTree

import numpy as np

from .errors import InputError
from .frame_tables import FrameTables, read_frame_tables
from .table import Table
from .vtu import Grid, read_vtu, read_with_vtk

_NAME = re.compile(r"(?P<part>.+)_(?P<number>\d+)\.p?vtu$")
#: What a case must set for a part that is not always there.
_SETTINGS = {"surfaces": ": set Output/surfaces = all or ends in the case",
             "tables": ": set Output/frame_tables = hdf5 in the case"}


@dataclasses.dataclass(frozen=True, repr=False)
class Frame:
    """The files of one instant, by part: particles, contacts, membrane,
    surfaces, walls, plate, subgrade, drum, and tables (HDF5)."""

    number: int                     #: in the names of the files
    time: float                     #: [s]
    files: dict[str, pathlib.Path]  #: by part

    def __repr__(self) -> str:
        return f"Frame({self.number}, {self.time:g} s: " \
               f"{', '.join(self.files)})"

    def path(self, part: str) -> pathlib.Path:
        """File of a part. InputError if the frame has none."""
        if part not in self.files:
            more = _SETTINGS.get(part, "")
            raise InputError(f"frame {self.number} has no {part}, it has "
                             f"{', '.join(self.files)}{more}")
        return self.files[part]

    def read(self, part: str) -> Grid:
        """The grid of a part, unless it is the tables."""
        return read_vtu(self.path(part))

    def vtk(self, part: str) -> Any:
        """The grid of a part as a vtkUnstructuredGrid (needs VTK)."""
        return read_with_vtk(self.path(part))

    def particles(self) -> Table:
        """The particles: id, position [m], radius [m] of the sphere of equal
        volume, mass [kg], loss [1] of the initial mass, volume [m^3],
        inscribed_radius [m], velocity [m/s], spin [rad/s], orientation (unit
        quaternion w, x, y, z from the frame of the body to the world)."""
        grid = self.read("particles")
        columns = {"position_m": grid.points}
        for name, values in grid.point_data.items():
            short = "orientation" if name == "orientation_wxyz" else name
            columns[short] = values
        order = np.argsort(columns["id"], kind="stable")
        return Table({name: columns[name][order] for name in
                      ("id", *(one for one in columns if one != "id"))},
                     str(self.path("particles")))

    def contacts(self) -> Table:
        """The touching contacts: from and to [m], normal_force and
        shear_force [N], overlap [m], kind (0 particle on particle, 1 on a
        plane or drum, 2 on a facet)."""
        grid = self.read("contacts")
        ends = grid.points.reshape(-1, 2, 3)
        return Table({"from_m": ends[:, 0], "to_m": ends[:, 1],
                      **grid.cell_data}, str(self.path("contacts")))

    def tables(self) -> FrameTables:
        """Particles and contacts in double precision, with normals, forces as
        vectors and stresses (needs h5py). InputError without
        ``Output/frame_tables = hdf5``, or if they are of another instant."""
        tables = read_frame_tables(self.path("tables"))
        if tables.time != self.time:
            raise InputError(f"{tables.path}: is of {tables.time:g} s, the "
                             f"frame of {self.time:g} s")
        return tables


def read_frames(folder: pathlib.Path) -> list[Frame]:
    """The frames that run.pvd names, in the order of time; none without it."""
    collection = folder / "run.pvd"
    if not collection.exists():
        return []
    frames: dict[int, Frame] = {}
    for entry in ElementTree.parse(collection).iter("DataSet"):
        path = folder / entry.get("file", "")
        found = _NAME.match(path.name)
        if not found or not path.exists():
            continue
        number = int(found["number"])
        frame = frames.setdefault(
            number, Frame(number, float(entry.get("timestep", "nan")), {}))
        frame.files[found["part"]] = path
        tables = path.with_name(f"tables_{found['number']}.h5")
        if tables.exists():
            frame.files["tables"] = tables
    return [frames[number] for number in sorted(frames)]
