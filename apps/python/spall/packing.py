"""Packings of particles: those of other programs, and placed particles."""
from __future__ import annotations

import csv
import dataclasses
import pathlib
from typing import Any, Callable, Sequence

import numpy as np

from .errors import InputError
from .table import Table

_HEADERS = {"orientation": ("qw", "qx", "qy", "qz"),
            "velocity": ("vx", "vy", "vz"), "spin": ("wx", "wy", "wz")}

# Names that dumps give to a quaternion, its scalar part first.
_QUATERNIONS = (("quatw", "quati", "quatj", "quatk"),
                ("quat1", "quat2", "quat3", "quat4"),
                ("qw", "qx", "qy", "qz"))
_SPINS = (("omegax", "omegay", "omegaz"), ("wx", "wy", "wz"))


@dataclasses.dataclass
class Packing:
    """Particles by rows; entry k of every array is the same particle."""

    position: np.ndarray                     #: (n, 3) [m]
    radius: np.ndarray                       #: (n,) of the equal sphere [m]
    orientation: np.ndarray | None = None    #: (n, 4) unit quaternion w x y z
    velocity: np.ndarray | None = None       #: (n, 3) [m/s]
    spin: np.ndarray | None = None           #: (n, 3) [rad/s]
    shape: list[str] | None = None           #: names of shape files
    material: list[str] | None = None        #: "particle" or "other"
    box: np.ndarray | None = None            #: (2, 3) lower, upper corner [m]
    source: str = ""

    def __post_init__(self) -> None:
        self.position = np.asarray(self.position, dtype=float).reshape(-1, 3)
        self.radius = np.asarray(self.radius, dtype=float)
        n = len(self.radius)
        where = self.source or "packing"
        if n == 0:
            raise InputError(f"{where}: has no particles")
        for name, width in (("position", 3), ("orientation", 4),
                            ("velocity", 3), ("spin", 3)):
            values = getattr(self, name)
            if values is None:
                continue
            values = np.asarray(values, dtype=float)
            if values.shape != (n, width):
                raise InputError(f"{where}: {name} has the form "
                                 f"{values.shape}, must be {(n, width)}")
            if not np.all(np.isfinite(values)):
                raise InputError(f"{where}: {name} must be finite numbers")
            setattr(self, name, values)
        if not np.all(self.radius > 0):
            row = int(np.flatnonzero(~(self.radius > 0))[0])
            raise InputError(f"{where}: particle {row + 1} has radius "
                             f"{self.radius[row]}, must be above 0")
        self._normalise()

    def _normalise(self) -> None:
        if self.orientation is None:
            return
        length = np.linalg.norm(self.orientation, axis=1, keepdims=True)
        # Text of few digits is near a length of 1, zero is no orientation.
        if not np.all(np.abs(length - 1) < 1e-2):
            raise InputError(f"{self.source or 'packing'}: an orientation is "
                             "no unit quaternion w, x, y, z")
        self.orientation = self.orientation / length

    def __len__(self) -> int:
        return len(self.radius)

    @classmethod
    def from_particles(cls, particles: Table) -> Packing:
        """Of the particles of a frame."""
        return cls(particles["position"], particles["radius"],
                   particles["orientation"], particles["velocity"],
                   particles["spin"], source=particles.source)

    def scaled(self, factor: float) -> Packing:
        """All lengths times a factor; velocities, too, as times stay."""
        def times(values: np.ndarray | None) -> np.ndarray | None:
            return None if values is None else values * factor
        return dataclasses.replace(
            self, position=self.position * factor,
            radius=self.radius * factor, velocity=times(self.velocity),
            box=times(self.box))

    def moved(self, by: Sequence[float]) -> Packing:
        """Shifted by a vector [m]."""
        shift = np.asarray(by, dtype=float)
        return dataclasses.replace(
            self, position=self.position + shift,
            box=None if self.box is None else self.box + shift)

    def bounds(self) -> np.ndarray:
        """(2, 3): lower and upper corner that the spheres reach [m]."""
        reach = self.radius[:, None]
        return np.array([(self.position - reach).min(axis=0),
                         (self.position + reach).max(axis=0)])

    def write_packing(self, path: str | pathlib.Path) -> None:
        """CSV that Scene/particles and Specimen/particles read. A box that
        begins at the origin is written as the comment ``# box LX LY LZ``."""
        columns: dict[str, Sequence[object]] = dict(
            zip("xyz", self.position.T.tolist()))
        columns["radius"] = self.radius.tolist()
        for name, header in _HEADERS.items():
            values = getattr(self, name)
            if values is not None:
                columns.update(zip(header, values.T.tolist()))
        for name in ("shape", "material"):
            values = getattr(self, name)
            if values is not None:
                columns[name] = list(values)
        with open(path, "w", newline="", encoding="utf-8") as file:
            if self.box is not None and np.all(self.box[0] == 0):
                sides = " ".join(repr(one) for one in self.box[1].tolist())
                file.write(f"# box {sides}\n")
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(columns)
            writer.writerows(zip(*columns.values()))


def read_packing(path: str | pathlib.Path, scale: float = 1.0,
                 step: int | None = None) -> Packing:
    """A packing of another program, or of Spall.

    Read are text dumps of LAMMPS and LIGGGHTS (``x y z`` or ``xu yu zu`` or
    ``xs ys zs``, ``radius`` or ``diameter``, and where there are velocities,
    spins and quaternions ``quatw quati quatj quatk`` or ``quat1`` to
    ``quat4``), text of Yade (``x y z r``, more columns are left out) and CSV
    of Spall (``x,y,z,radius``). What the file is follows from its first line.

    ``scale`` is the unit of length of the file in metres. Of a dump with
    several time steps the last is taken, or ``step``.
    """
    file = pathlib.Path(path)
    try:
        lines = file.read_text(encoding="utf-8-sig").splitlines()
    except FileNotFoundError:
        raise InputError(f"{file}: no such file") from None
    except UnicodeDecodeError:
        raise InputError(f"{file}: is no text file") from None
    first = next((line for line in lines
                  if line.strip() and not line.startswith("#")), "")
    readers: list[tuple[bool, Callable[[], Packing]]] = [
        (first.startswith("ITEM:"), lambda: _read_dump(file, lines, step)),
        ("," in first, lambda: _read_csv(file, lines)),
        (bool(first), lambda: _read_yade(file, lines))]
    for is_form, read in readers:
        if is_form:
            packing = read()
            return packing if scale == 1.0 else packing.scaled(scale)
    raise InputError(f"{file}: has no particles")


def _numbers(path: pathlib.Path, rows: list[tuple[int, list[str]]],
             width: int) -> np.ndarray:
    """The words of rows (line number, words) as numbers."""
    for number, words in rows:
        if len(words) < width:
            raise InputError(f"{path}:{number}: has {len(words)} entries, "
                             f"must be {width}")
    try:
        return np.array([words[:width] for _, words in rows], dtype=float)
    except ValueError:
        for number, words in rows:
            try:
                [float(word) for word in words[:width]]
            except ValueError as error:
                raise InputError(f"{path}:{number}: {error}") from None
        raise


# --- dumps of LAMMPS and LIGGGHTS

def _read_dump(path: pathlib.Path, lines: list[str],
               step: int | None) -> Packing:
    starts = [k for k, line in enumerate(lines)
              if line.startswith("ITEM: TIMESTEP")]
    steps = [int(lines[k + 1]) for k in starts if k + 1 < len(lines)]
    if not steps:
        raise InputError(f"{path}: has no ITEM: TIMESTEP")
    if step is not None and step not in steps:
        raise InputError(f"{path}: has no time step {step}, it has "
                         f"{steps[0]} to {steps[-1]}")
    which = len(steps) - 1 if step is None else steps.index(step)
    end = starts[which + 1] if which + 1 < len(starts) else len(lines)
    return _dump_step(path, lines, starts[which], end)


def _dump_step(path: pathlib.Path, lines: list[str], start: int,
               end: int) -> Packing:
    atoms, bounds = -1, None
    for k in range(start, end):
        if lines[k].startswith("ITEM: BOX BOUNDS"):
            if "xy" in lines[k].split():
                raise InputError(f"{path}:{k + 1}: the box is tilted, must be "
                                 "upright")
            bounds = _numbers(path, [(n + 1, lines[n].split())
                                     for n in range(k + 1, k + 4)], 2).T
        elif lines[k].startswith("ITEM: ATOMS"):
            atoms = k
            break
    if atoms < 0:
        raise InputError(f"{path}: time step without ITEM: ATOMS")
    names = lines[atoms].split()[2:]
    rows = [(k + 1, lines[k].split()) for k in range(atoms + 1, end)
            if lines[k].strip()]
    if not rows:
        raise InputError(f"{path}:{atoms + 1}: has no particles")
    data = dict(zip(names, _numbers(path, rows, len(names)).T))
    packing = Packing(
        _dump_positions(path, data, bounds), _dump_radii(path, data),
        _group(data, _QUATERNIONS), _group(data, (("vx", "vy", "vz"),)),
        _group(data, _SPINS), box=bounds, source=str(path))
    if "id" not in data:
        return packing
    return _in_order(packing, np.argsort(data["id"], kind="stable"))


def _group(data: dict[str, np.ndarray],
           groups: Sequence[Sequence[str]]) -> np.ndarray | None:
    for names in groups:
        if all(name in data for name in names):
            return np.stack([data[name] for name in names], axis=1)
    return None


def _dump_positions(path: pathlib.Path, data: dict[str, np.ndarray],
                    bounds: np.ndarray | None) -> np.ndarray:
    positions = _group(data, (("x", "y", "z"), ("xu", "yu", "zu")))
    if positions is not None:
        return positions
    shares = _group(data, (("xs", "ys", "zs"),))
    if shares is None or bounds is None:
        raise InputError(f"{path}: ITEM: ATOMS must have x y z, xu yu zu or "
                         "xs ys zs")
    return bounds[0] + shares * (bounds[1] - bounds[0])


def _dump_radii(path: pathlib.Path,
                data: dict[str, np.ndarray]) -> np.ndarray:
    if "radius" in data:
        return data["radius"]
    if "diameter" in data:
        return 0.5 * data["diameter"]
    raise InputError(f"{path}: ITEM: ATOMS must have radius or diameter")


def _in_order(packing: Packing, order: np.ndarray) -> Packing:
    names = ("position", "radius", "orientation", "velocity", "spin")
    return dataclasses.replace(packing, **{
        name: values[order] for name in names
        if (values := getattr(packing, name)) is not None})


# --- Yade and Spall

def _read_yade(path: pathlib.Path, lines: list[str]) -> Packing:
    rows = [(number, line.split()) for number, line in enumerate(lines, 1)
            if line.strip() and not line.lstrip().startswith("#")]
    table = _numbers(path, rows, 4)
    return Packing(table[:, :3], table[:, 3], source=str(path))


def _read_csv(path: pathlib.Path, lines: list[str]) -> Packing:
    table = Table.read(path, is_complete=True)
    data = {name: table[name] for name in table}

    def group(names: Sequence[str]) -> np.ndarray | None:
        return _group(data, (names,))

    positions = group(("x", "y", "z"))
    if positions is None or not {"radius", "diameter"} & set(data):
        raise InputError(f"{path}: the header must have x,y,z and radius or "
                         "diameter")
    radius = data["radius"] if "radius" in data else 0.5 * data["diameter"]
    box = None
    for number, line in enumerate(lines, 1):
        if line.startswith("#") and line[1:].split()[:1] == ["box"]:
            sides = _numbers(path, [(number, line[1:].split()[1:])], 3)[0]
            box = np.array([np.zeros(3), sides])
    columns: dict[str, Any] = {name: group(header)
                               for name, header in _HEADERS.items()}
    columns.update({name: list(data[name].astype(str))
                    for name in ("shape", "material") if name in data})
    return Packing(positions, radius, box=box, source=str(path), **columns)
