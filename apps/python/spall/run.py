"""A run folder."""
from __future__ import annotations

import functools
import json
import pathlib

from .errors import InputError
from .frame_tables import FrameTables
from .frames import Frame, read_frames
from .mesh import write_surfaces
from .packing import Packing
from .plots import RunPlots
from .prm import read_resolved
from .table import Record, Table


class Run:
    """What a run has written, read when it is first asked for.

    A run that is still going can be read: ``refresh()`` forgets what has been
    read. Tables have units (``run.history.unit("time")``); ``run.case`` is
    the case with every parameter as run, by section.
    """

    def __init__(self, folder: str | pathlib.Path) -> None:
        self.folder = pathlib.Path(folder)
        if not (self.folder / "case.prm").is_file():
            raise InputError(f"{folder}: is no run folder, it has no case.prm")

    @property
    def name(self) -> str:
        """Name of the folder."""
        return self.folder.name

    @functools.cached_property
    def case(self) -> Record:
        """Every parameter as run: ``run.case["Loading"]["frequency"]``."""
        return read_resolved(self.folder / "case.prm")

    @property
    def kind(self) -> str:
        """Kind of the test, as dynamic_triaxial."""
        return self.case["Case"]["kind"]

    @property
    def table_names(self) -> list[str]:
        """Names of the tables (.csv) that the run has."""
        return sorted(path.stem for path in self.folder.glob("*.csv"))

    def table(self, name: str) -> Table:
        """Any table of the run, as ``boundary_profile_end``."""
        if name not in self._tables:
            path = self.folder / f"{name}.csv"
            if not path.exists():
                raise InputError(
                    f"{self.folder}: has no {name}.csv; this run of kind "
                    f"{self.kind} has {', '.join(self.table_names)}")
            self._tables[name] = Table.read(path)
        return self._tables[name]

    @functools.cached_property
    def _tables(self) -> dict[str, Table]:
        return {}

    @property
    def history(self) -> Table:
        """Stresses, strains and energies over time."""
        return self.table("history")

    @property
    def loading(self) -> Table:
        """The rows of history that belong to the loading; all rows of a kind
        without preparation."""
        history = self.history
        if "stage" not in history:
            return history
        return history.rows(history["stage"] == 2)

    @property
    def cycles(self) -> Table:
        """A row for each load cycle."""
        return self.table("cycles")

    @property
    def stages(self) -> Table:
        """A row for each stage of a loading path."""
        return self.table("stages")

    @property
    def events(self) -> Table:
        """Breakage events."""
        return self.table("events")

    @property
    def ledger(self) -> Table:
        """Work and impulse exchanged between particles and bodies."""
        return self.table("ledger")

    @functools.cached_property
    def summary(self) -> Record:
        """Results of the run as a whole. InputError before its end."""
        path = self.folder / "summary.json"
        if not path.exists():
            raise InputError(f"{self.folder}: has no summary.json, which a "
                             "run writes at its end")
        return Record(json.loads(path.read_text(encoding="utf-8")),
                      source=str(path))

    @property
    def is_complete(self) -> bool:
        """Whether the run has come to its end."""
        return (self.folder / "summary.json").exists() and \
            bool(self.summary["is_complete"])

    @property
    def warnings(self) -> list[str]:
        """Warnings of the run."""
        return list(self.summary["warnings"])

    @property
    def log(self) -> str:
        """Text of log.txt."""
        path = self.folder / "log.txt"
        return path.read_text(encoding="utf-8") if path.exists() else ""

    @functools.cached_property
    def frames(self) -> list[Frame]:
        """States at instants; ``run.frames[-1].time`` is in s."""
        return read_frames(self.folder)

    def frame(self, frame: Frame | int = -1) -> Frame:
        """A frame by its position in ``frames``; the last by default."""
        if isinstance(frame, Frame):
            return frame
        if not self.frames:
            raise InputError(f"{self.folder}: has no frames")
        return self.frames[frame]

    def particles(self, frame: Frame | int = -1) -> Table:
        """The particles of a frame, see ``Frame.particles``."""
        return self.frame(frame).particles()

    def contacts(self, frame: Frame | int = -1) -> Table:
        """The contacts of a frame, see ``Frame.contacts``."""
        return self.frame(frame).contacts()

    def tables(self, frame: Frame | int = -1) -> FrameTables:
        """The HDF5 tables of a frame, see ``Frame.tables``."""
        return self.frame(frame).tables()

    def packing(self, frame: Frame | int = -1) -> Packing:
        """The particles of a frame as a packing: positions, orientations,
        velocities, spins and radii of the spheres of equal volume."""
        return Packing.from_particles(self.particles(frame))

    def write_mesh(self, frame: Frame | int, path: str | pathlib.Path,
                   scale: float = 1.0) -> None:
        """True surfaces of all particles of a frame as one STL or PLY file, by
        its ending. ``scale`` multiplies lengths: 1000 writes millimetres. PLY
        keeps the id of the particle of each triangle."""
        write_surfaces(self.frame(frame).read("surfaces"), pathlib.Path(path),
                       scale)

    @property
    def plot(self) -> RunPlots:
        """Charts of the run (needs matplotlib)."""
        return RunPlots(self)

    def refresh(self) -> None:
        """Forgets what has been read, so that it is read again."""
        for name in ("case", "_tables", "summary", "frames"):
            self.__dict__.pop(name, None)

    def __repr__(self) -> str:
        return f"Run({str(self.folder)!r})"
