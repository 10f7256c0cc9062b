"""A case: the input of a run."""
from __future__ import annotations

import contextlib
import json
import pathlib
import re
import tempfile
import warnings
from typing import Any, Callable, Iterator, MutableMapping, NoReturn

from .errors import InputError, SpallError
from .parameters import Parameter, parameters_of, values_of
from .prm import as_text, prm_text
from .program import Progress, call, find_program, follow, start_words
from .run import Run


class Case(MutableMapping[str, Any]):
    """Parameters of a case by Section/key.

    ``case["Loading/frequency"] = 20`` is checked at once against the list of
    the program: key, type and range. Relations between keys and the files
    that they name are checked by ``validate()`` and when the case is run. A
    key that is not set has the default of its kind; ``del`` sets it back.
    ``case["Material/file"] = FILE`` takes the values of a material file for
    all keys that have their defaults.
    """

    def __init__(self, kind: str) -> None:
        """All defaults of a kind. Most kinds need more, which
        ``from_template`` sets."""
        self._list = parameters_of(kind)
        self._values: dict[str, Any] = {}
        self._walls: list[str] = []

    @classmethod
    def from_template(cls, kind: str, preset: str = "") -> Case:
        """The case that ``spall template KIND`` prints; with the settings of a
        preset over it (fast, standard, reference, article)."""
        case = cls(kind)
        case._take(case._list.values)
        if preset:
            case.apply_preset(preset)
        return case

    @classmethod
    def read(cls, path: str | pathlib.Path, preset: str = "") -> Case:
        """A case file, .prm or .json, validated by the program. Paths within
        it are taken from its folder; the values of its material file, and of
        the preset, are written out."""
        path = pathlib.Path(path)
        options = ["--set", f"preset={preset}"] if preset else []
        printed = json.loads(call("check", path, "--json", *options))
        case = cls(printed["kind"])
        case._take(_with_paths(printed, path.absolute().parent))
        return case

    @property
    def kind(self) -> str:
        """Kind of the test."""
        return self._list.kind

    @property
    def seed_key(self) -> str:
        """Section/key of the seed of the particles; empty if the kind has
        none."""
        return self._list.seed_key

    @property
    def walls(self) -> list[str]:
        """Names of the walls (sections Walls/NAME)."""
        return list(self._walls)

    def parameter(self, name: str) -> Parameter:
        """Unit, range, default and sentence of Section/key."""
        return self._list.find(name)

    def unit(self, name: str) -> str:
        """Unit of Section/key, "-" if it has none."""
        return self.parameter(name).unit

    def sections(self) -> dict[str, str]:
        """Sections of this kind, with a sentence on each."""
        return dict(self._list.sections)

    def __getitem__(self, name: str) -> Any:
        parameter = self._list.find(name)
        return self._values.get(parameter.name, self._default(parameter))

    def __setitem__(self, name: str, value: Any) -> None:
        parameter = self._list.find(name)
        if parameter.name == "Case/kind" and value != self.kind:
            raise InputError(f"Case/kind = {value}: the kind of a case stays, "
                             f"use Case.from_template({value!r})")
        checked = parameter.checked(value)
        if parameter.section.startswith("Walls/"):
            self._add_wall(parameter.section.partition("/")[2])
        self._values[parameter.name] = checked
        if parameter.name == "Material/file" and checked:
            self._write_out_material()

    def _write_out_material(self) -> None:
        """The values of the material file where the case has the defaults,
        instead of the name of the file."""
        plain = Case.from_template(self.kind)  # which the program accepts
        named = plain.copy()
        named._values["Material/file"] = self._values.pop("Material/file")
        printed = json.loads(named._call_check("--json"))
        self._take({name: value for name, value in values_of(printed).items()
                    if value != plain[name] and name not in self._values})

    def __delitem__(self, name: str) -> None:
        self._values.pop(self._list.find(name).name, None)

    def __iter__(self) -> Iterator[str]:
        return iter(self._list.names(self._walls))

    def __len__(self) -> int:
        return len(self._list.names(self._walls))

    def __contains__(self, name: object) -> bool:
        try:
            self._list.find(str(name))
        except InputError:
            return False
        return True

    def clear(self) -> None:
        """Sets all keys back to the defaults of the kind and removes the
        walls."""
        self._values.clear()
        self._walls.clear()

    def popitem(self) -> NoReturn:
        """TypeError: a case always has all keys of its kind."""
        raise TypeError("popitem: a case always has all keys of its kind; del "
                        "sets one back to its default, clear() sets all back")

    def _add_wall(self, name: str) -> None:
        if not name.isascii() or not name.replace("_", "a").isalnum():
            raise InputError(f"Walls/{name}: the name of a wall is letters, "
                             "digits and _")
        if name not in self._walls:
            self._walls.append(name)

    def remove_wall(self, name: str) -> None:
        """Removes the section Walls/NAME."""
        if name not in self._walls:
            raise InputError(f"Walls/{name}: no such wall, there are "
                             f"{', '.join(self._walls) or 'none'}")
        self._walls.remove(name)
        for key in [one for one in self._values
                    if one.startswith(f"Walls/{name}/")]:
            del self._values[key]

    def _default(self, parameter: Parameter) -> Any:
        """Of a wall the material of the section Wall counts."""
        if parameter.section.startswith("Walls/"):
            inherited = f"Wall/{parameter.key}"
            if inherited in self:
                return self[inherited]
        return parameter.default

    def _take(self, values: dict[str, Any]) -> None:
        """Sets values; those of walls last, which inherit from others."""
        for name in sorted(values, key=lambda one: one.startswith("Walls/")):
            value = values[name]
            if name.startswith("Walls/"):
                self._add_wall(name.split("/")[1])
            if name != "Material/file" and value != self[name]:
                self[name] = value

    def changed(self) -> dict[str, Any]:
        """Section/key and value of what differs from the defaults."""
        return {name: self[name] for name in self
                if self[name] != self._default(self._list.find(name))}

    def copy(self) -> Case:
        """An independent copy."""
        other = type(self).__new__(type(self))
        other.__dict__.update(self.__dict__)
        other._values, other._walls = dict(self._values), list(self._walls)
        return other

    def __copy__(self) -> Case:
        return self.copy()

    def __deepcopy__(self, _memo: object) -> Case:
        return self.copy()

    def apply_preset(self, preset: str) -> None:
        """Puts the settings of a preset of this kind over the case."""
        with self._file() as file:
            printed = json.loads(call("check", file, "--json", "--set",
                                      f"preset={preset}"))
        self._take(values_of(printed))

    def validate(self) -> None:
        """Checks the parameters against each other and the files they name.
        InputError with the line of the program. Its notes, as on unusual
        values, are warnings (UserWarning)."""
        with self._file() as file:
            printed = json.loads(call("check", file, "--json"))
            notes = [_without_file(note, file) for note in printed["notices"]]
        for note in notes:
            warnings.warn(note, UserWarning, stacklevel=2)

    def check(self) -> str:
        """Builds the scene and returns what ``spall check`` prints: particles,
        stable step, memory and the time that the run will take."""
        return self._call_check()

    def _call_check(self, *options: str) -> str:
        with self._file() as file:
            return call("check", file, *options)

    @contextlib.contextmanager
    def _file(self, name: str = "case.prm") -> Iterator[pathlib.Path]:
        """The case in a file for the time of the block. Errors of the program
        in the block do not name the file."""
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / name
            self.write(file)
            try:
                yield file
            except SpallError as error:
                error.args = (_without_file(str(error), file),)
                raise

    def resolved(self) -> dict[str, Any]:
        """What a file needs: kind, changes and walls, paths from here."""
        values: dict[str, Any] = {"Case/kind": self.kind}
        values.update(self.changed())
        for wall in self._walls:
            values.setdefault(f"Walls/{wall}/mesh",
                              self[f"Walls/{wall}/mesh"])
        for name, value in values.items():
            if self._list.find(name).type == "path" and value and \
                    pathlib.Path(value).exists():
                values[name] = str(pathlib.Path(value).absolute())
        return values

    def write(self, path: str | pathlib.Path) -> None:
        """A case file, .prm or .json by the ending, with what differs from the
        defaults. Paths of files that are there are made absolute; others are
        searched in the data folder of the program."""
        path = pathlib.Path(path)
        values = self.resolved()
        if path.suffix == ".prm":
            path.write_text(prm_text("", values).lstrip(), encoding="utf-8")
        elif path.suffix == ".json":
            path.write_text(json.dumps(_nested(values), indent=2) + "\n",
                            encoding="utf-8")
        else:
            raise InputError(f"{path}: a case file ends in .prm or .json")

    def run(self, out: str | pathlib.Path, *, ranks: int = 1,
            threads: int = 1, resume: bool = False, overwrite: bool = False,
            preparations: str | pathlib.Path | None = None,
            progress: Callable[[Progress], object] | None = None,
            mpirun: str | None = None) -> Run:
        """Runs the case in the folder ``out`` and returns the run.

        ``ranks`` processes are started by ``mpirun`` (words; else the
        environment variable SPALL_MPIRUN, else "mpirun"), each with
        ``threads`` threads. ``resume`` goes on with a run that was stopped,
        ``overwrite`` begins an unfinished one from the start. Specimens are
        stored in the folder ``preparations`` and taken from there.
        ``progress`` is called about every ten seconds; where it raises, the
        run writes a checkpoint and stops.

        InputError or RunError with the line of the program if it fails. A run
        that got a signal to stop returns: see ``Run.is_complete``. Notes of
        the program on the case, as on unusual values, are warnings
        (UserWarning).
        """
        for name, count in (("ranks", ranks), ("threads", threads)):
            if count < 1:
                raise InputError(f"{name} = {count}: must be at least 1")
        out = pathlib.Path(out).absolute()
        notes: list[str] = []
        with self._file(f"{out.name or 'case'}.prm") as file:
            words = [*start_words(ranks, mpirun), str(find_program()), "run",
                     str(file), "--out", str(out), "--threads", str(threads)]
            words += ["--resume"] if resume else []
            words += ["--overwrite"] if overwrite else []
            if preparations is not None:
                words += ["--preparations", str(preparations)]
            try:
                follow(words, progress, notes.append)
            finally:
                for note in notes:
                    warnings.warn(_without_file(note, file), UserWarning,
                                  stacklevel=2)
        return Run(out)

    def __repr__(self) -> str:
        return f"Case of kind {self.kind}: " + ", ".join(
            f"{name} = {as_text(value)}"
            for name, value in self.changed().items())


def _without_file(message: str, file: pathlib.Path) -> str:
    """A message of the program on a case of Python: without the file that the
    case was written to. Instead of its folder the paths of the case are
    searched in the current one (``Case.resolved``)."""
    where = re.escape(str(file)) + r"(:\d+)?( \(default\))?: "
    return re.sub(where, "", message).replace(str(file.parent),
                                              "the current folder")


def _nested(values: dict[str, Any]) -> dict[str, Any]:
    nested: dict[str, Any] = {}
    for name, value in values.items():
        *sections, key = name.split("/")
        inner = nested
        for section in sections:
            inner = inner.setdefault(section, {})
        inner[key] = list(value) if isinstance(value, tuple) else value
    return nested


def _with_paths(printed: dict[str, Any],
                folder: pathlib.Path) -> dict[str, Any]:
    """Values of a printed case; paths from its folder made absolute."""
    values = values_of(printed)
    for section in printed["sections"]:
        for one in section["parameters"]:
            name = f"{section['name']}/{one['key']}"
            if one["type"] == "path" and values.get(name) and \
                    (folder / values[name]).exists():
                values[name] = str((folder / values[name]).resolve())
    return values
