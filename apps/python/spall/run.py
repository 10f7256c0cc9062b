"""A run folder."""
from __future__ import annotations

import json
import pathlib
from typing import Any, Callable, cast

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
    read. So does a run that ends, goes on or begins again in the folder, so
    that old and new results are never mixed. Tables have units
    (``run.history.unit("time")``); ``run.case`` is the case with every
    parameter as run, by section.
    """

    def __init__(self, folder: str | pathlib.Path) -> None:
        self.folder = pathlib.Path(folder).absolute()
        self._read: dict[str, Any] = {}
        self._times = self._modification_times()
        if not (self.folder / "case.prm").is_file():
            raise InputError(f"{folder}: is no run folder, it has no case.prm")

    @property
    def name(self) -> str:
        """Name of the folder."""
        return self.folder.name

    def _modification_times(self) -> list[int]:
        """Of the files that a run writes at its start and at its end [ns]; 0
        of one that is not there."""
        times = []
        for name in ("case.prm", "summary.json"):
            try:
                times.append((self.folder / name).stat().st_mtime_ns)
            except OSError:
                times.append(0)
        return times

    def _kept(self, name: str, read: Callable[[], Any]) -> Any:
        """What has been read under this name, else what ``read`` returns. All
        is forgotten where the folder belongs to another run than before, but
        not where it was removed."""
        times = self._modification_times()
        if times != self._times and times[0] != 0:
            self.refresh()
        if name not in self._read:
            self._read[name] = read()
        return self._read[name]

    @property
    def case(self) -> Record:
        """Every parameter as run: ``run.case["Loading"]["frequency"]``."""
        file = self.folder / "case.prm"
        return cast(Record, self._kept("case", lambda: read_resolved(file)))

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
        return cast(Table, self._kept(f"{name}.csv",
                                      lambda: self._read_table(name)))

    def _read_table(self, name: str) -> Table:
        path = self.folder / f"{name}.csv"
        if not path.exists():
            raise InputError(
                f"{self.folder}: has no {name}.csv; this run of kind "
                f"{self.kind} has {', '.join(self.table_names)}")
        return Table.read(path)

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

    @property
    def summary(self) -> Record:
        """Results of the run as a whole. InputError before its end."""
        return cast(Record, self._kept("summary", self._read_summary))

    def _read_summary(self) -> Record:
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

    @property
    def frames(self) -> list[Frame]:
        """States at instants; ``run.frames[-1].time`` is in s."""
        return cast("list[Frame]", self._kept(
            "frames", lambda: read_frames(self.folder)))

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
        self._read.clear()
        self._times = self._modification_times()

    def __repr__(self) -> str:
        return f"Run({str(self.folder)!r})"
