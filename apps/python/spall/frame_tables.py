"""Tables of a frame: frames/tables_NNNNN.h5, in double precision."""
from __future__ import annotations

import dataclasses
import pathlib
from typing import Any

import numpy as np

from .errors import InputError, need
from .table import Table

#: The layout that is read; later ones of this number only have more columns.
VERSION = 1
_SCHEMA = "spall_frame_tables"
_GROUPS = ("particles", "contacts", "boundaries", "shapes")


@dataclasses.dataclass(frozen=True, repr=False)
class FrameTables:
    """Particles and contacts at one instant, as docs/user/frame_tables.md
    describes them. ``particles["position"]`` is an array, and
    ``particles.unit("position")`` its unit."""

    particles: Table   #: a row for each particle, in the order of the ids
    contacts: Table    #: a row for each contact point
    boundaries: Table  #: name and kind of each boundary
    shapes: list[str]  #: names that the column ``shape`` of particles counts
    title: str         #: of the case
    kind: str          #: of the case
    program: str       #: version of Spall that wrote the file
    frame: int         #: number of the frame
    step: int          #: of the run
    time: float        #: [s]
    #: Centre and length of a periodic cell, 0 where it has none [m]
    cell: tuple[np.ndarray, np.ndarray] | None
    path: pathlib.Path

    def __repr__(self) -> str:
        return f"FrameTables({self.path.name}, {self.time:g} s, " \
               f"{self.particles.n_rows} particles, " \
               f"{self.contacts.n_rows} contacts)"


def read_frame_tables(path: str | pathlib.Path) -> FrameTables:
    """Reads a file of tables (needs h5py). InputError on a file that is none
    or not whole."""
    path = pathlib.Path(path)
    h5py = need("h5py", f"reading {path.name}")
    if not path.is_file():
        raise InputError(f"{path}: no such file")
    try:
        with h5py.File(path, "r") as file:
            return _tables(path, file)
    except (OSError, KeyError, RuntimeError) as error:
        reason = " ".join(str(error).split()).strip("'\"")
        raise InputError(f"{path}: is no whole file of frame tables: "
                         f"{reason}") from error


def _tables(path: pathlib.Path, file: Any) -> FrameTables:
    if file.attrs.get("schema") != _SCHEMA:
        raise InputError(f"{path}: schema = {file.attrs.get('schema')}: must "
                         f"be {_SCHEMA}")
    version = int(file.attrs["schema_version"])
    if version != VERSION:
        raise InputError(f"{path}: schema_version = {version}: must be "
                         f"{VERSION}, which this package reads")
    particles, contacts, boundaries, shapes = (
        _table(path, file[name]) for name in _GROUPS)
    is_periodic = "periodic_cell_length_m" in file.attrs
    return FrameTables(
        particles, contacts, boundaries, shapes["name"].tolist(),
        title=str(file.attrs["case_title"]),
        kind=str(file.attrs["case_kind"]),
        program=str(file.attrs["spall_version"]),
        frame=int(file.attrs["frame"]), step=int(file.attrs["step"]),
        time=float(file.attrs["time_s"]),
        cell=(file.attrs["periodic_cell_centre_m"],
              file.attrs["periodic_cell_length_m"]) if is_periodic else None,
        path=path)


def _table(path: pathlib.Path, group: Any) -> Table:
    columns = {}
    for name, values in group.items():
        is_text = values.dtype.kind == "O"
        short = "orientation" if name == "orientation_wxyz" else name
        columns[short] = np.array([one.decode() for one in values[()]],
                                  dtype=str) if is_text else values[()]
    return Table(columns, f"{path}, {group.name.strip('/')}")
