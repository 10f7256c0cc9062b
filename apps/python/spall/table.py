"""Columns and values with units."""
from __future__ import annotations

import csv
import pathlib
from typing import TYPE_CHECKING, Any, Iterator, Mapping

import numpy as np

from .errors import InputError, UnknownKey, need
from .units import did_you_mean, label, split_unit

if TYPE_CHECKING:
    import pandas


def _short_names(full_names: list[str],
                 units: Mapping[str, str]) -> dict[str, tuple[str, str]]:
    """Full name -> (name without unit, unit). Names that would be the same
    without their units keep them, and so do names of ``units``, which has
    the unit of a name that does not end in it."""
    split = {name: (name, units[name]) if name in units else split_unit(name)
             for name in full_names}
    count: dict[str, int] = {}
    for name, _ in split.values():
        count[name] = count.get(name, 0) + 1
    return {full: (name if count[name] == 1 else full, unit)
            for full, (name, unit) in split.items()}


class Table(Mapping[str, np.ndarray]):
    """Columns of equal length by name, each with its unit.

    ``table["time"]`` and ``table["time_s"]`` are the same array. Iteration is
    over the names without units, in the order of the file. A column of vectors
    has one row per entry and one column per component.
    """

    def __init__(self, columns: Mapping[str, np.ndarray], source: str = "",
                 units: Mapping[str, str] | None = None) -> None:
        """``columns`` by full name, ``name_unit``; ``units`` by name of those
        columns whose names do not end in their units."""
        self._given_units = dict(units or {})
        self._names = _short_names(list(columns), self._given_units)
        self._columns = {self._names[full][0]: np.asarray(values)
                         for full, values in columns.items()}
        self._units = dict(self._names.values())
        self._full = {short: full for full, (short, _) in self._names.items()}
        self.source = source
        lengths = {len(values) for values in self._columns.values()}
        if len(lengths) > 1:
            raise InputError(f"{source or 'table'}: columns of different "
                             f"lengths {sorted(lengths)}")
        self.n_rows: int = lengths.pop() if lengths else 0

    @classmethod
    def read(cls, path: str | pathlib.Path,
             is_complete: bool = False) -> Table:
        """A CSV file with one header line. Lines that begin with # are
        comments. A last line without its end is left out: the run may still
        be writing it. It is read if the file ``is_complete``."""
        path = pathlib.Path(path)
        try:
            text = path.read_text(encoding="utf-8-sig")
        except FileNotFoundError:
            raise InputError(f"{path}: no such file") from None
        whole = text if is_complete else text[:text.rfind("\n") + 1]
        rows = [row for row in csv.reader(
            line for line in whole.splitlines() if not line.startswith("#"))
            if row]
        if not rows:
            raise InputError(f"{path}: has no header line")
        header, *entries = rows
        for number, row in enumerate(entries, 1):
            if len(row) != len(header):
                raise InputError(f"{path}: row {number} has {len(row)} "
                                 f"entries, the header {len(header)}")
        columns = zip(*entries) if entries else [()] * len(header)
        return cls({name: _array(name, column)
                    for name, column in zip(header, columns)}, str(path))

    def _short(self, name: str) -> str:
        if name in self._columns:
            return name
        if name in self._names:
            return self._names[name][0]
        raise UnknownKey(f"{self.source or 'table'}: no column {name}"
                         f"{did_you_mean(name, self._columns)}")

    def __getitem__(self, name: str) -> np.ndarray:
        return self._columns[self._short(name)]

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        """Number of columns; ``n_rows`` is the number of rows."""
        return len(self._columns)

    def __contains__(self, name: object) -> bool:
        return name in self._columns or name in self._names

    def unit(self, name: str) -> str:
        """Unit of a column, "1" if it has none."""
        return self._units[self._short(name)]

    def full_name(self, name: str) -> str:
        """Name of a column with its unit, as in the file."""
        return self._full[self._short(name)]

    def label(self, name: str) -> str:
        """Text for an axis: "Axial stress (Pa)"."""
        short = self._short(name)
        return label(short, self._units[short])

    def rows(self, which: Any) -> Table:
        """The rows that a mask, slice or list of indices picks."""
        return Table({self._full[name]: values[which]
                      for name, values in self._columns.items()}, self.source,
                     self._given_units)

    def with_units(self, units: Mapping[str, str]) -> Table:
        """The same columns with units of some that have none in the file."""
        return Table({self._full[name]: values
                      for name, values in self._columns.items()}, self.source,
                     {**self._given_units, **units})

    def to_pandas(self) -> pandas.DataFrame:
        """A data frame with full names; ``frame.attrs["units"]`` by name.
        Vectors have a column for each component: ``velocity_x_m_per_s``."""
        pandas = need("pandas", "Table.to_pandas")
        flat, units = {}, {}
        for full, values, unit in self._flat():
            flat[full] = values
            units[full] = unit
        frame = pandas.DataFrame(flat)
        frame.attrs["units"] = units
        return frame

    def _flat(self) -> Iterator[tuple[str, np.ndarray, str]]:
        """Full name, values and unit; vectors by component."""
        for name, values in self._columns.items():
            full, unit = self._full[name], self._units[name]
            if values.ndim == 1:
                yield full, values, unit
                continue
            ending = full[len(name):] if full.startswith(name) else ""
            axes = "xyz" if values.shape[1] == 3 else "0123456789"
            for axis, column in zip(axes, values.T):
                yield f"{name}_{axis}{ending}", column, unit

    def write_csv(self, path: str | pathlib.Path) -> None:
        """All columns with full names; numbers keep all their digits."""
        flat = {full: values for full, values, _ in self._flat()}
        with open(path, "w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(flat)
            writer.writerows(zip(*(column.tolist()
                                   for column in flat.values())))

    def __repr__(self) -> str:
        shown = ", ".join(f"{name} [{self._units[name]}]"
                          for name in self._columns)
        return f"Table of {self.n_rows} rows: {shown}"


def _array(name: str, entries: tuple[str, ...]) -> np.ndarray:
    """Numbers as float64, whole numbers without a unit as int64, others as
    text. An empty entry among numbers is no number (nan)."""
    has_unit = split_unit(name)[0] != name
    if entries and not has_unit:
        try:
            return np.array([int(entry) for entry in entries], dtype=np.int64)
        except ValueError:
            pass
    try:
        return np.array([float(entry) if entry else np.nan
                         for entry in entries])
    except ValueError:
        return np.array(entries, dtype=str)


class Record(Mapping[str, Any]):
    """Values by name, each with its unit; values may be records themselves.

    ``record["walls/lid_force_z"]`` is ``record["walls"]["lid_force_z"]``.
    """

    def __init__(self, values: Mapping[str, Any],
                 units: Mapping[str, str] | None = None,
                 source: str = "") -> None:
        """``values`` by full name, ``name_unit``, or by name if ``units`` has
        the units by name."""
        if units is None:
            names = _short_names(list(values), {})
        else:
            names = {name: (name, units.get(name, "1")) for name in values}
        self._names = names
        self._units = dict(names.values())
        self._values = {
            names[full][0]: Record(_with_ending(value, full, names[full][0]),
                                   source=source)
            if isinstance(value, dict) else value
            for full, value in values.items()}
        self.source = source

    def _find(self, name: str) -> tuple[Record, str]:
        if name in self._values:
            return self, name
        if name in self._names:
            return self, self._names[name][0]
        first, slash, rest = name.partition("/")
        inner = self._values.get(first)
        if slash and isinstance(inner, Record):
            return inner._find(rest)
        raise UnknownKey(f"{self.source or 'record'}: no value {name}"
                         f"{did_you_mean(name, self._values)}")

    def __getitem__(self, name: str) -> Any:
        record, key = self._find(name)
        return record._values[key]

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    def __contains__(self, name: object) -> bool:
        try:
            self._find(str(name))
        except KeyError:
            return False
        return True

    def unit(self, name: str) -> str:
        """Unit of a value, "1" if it has none."""
        record, key = self._find(name)
        return record._units[key]

    def full_name(self, name: str) -> str:
        """Name of a value with its unit, as in the file."""
        record, key = self._find(name)
        return next(full for full, (short, _) in record._names.items()
                    if short == key)

    def flat(self, above: str = "") -> Iterator[tuple[str, Any, str]]:
        """Every value that is no record: (name with /, value, unit)."""
        for name, value in self._values.items():
            if isinstance(value, Record):
                yield from value.flat(f"{above}{name}/")
            else:
                yield above + name, value, self._units[name]

    def as_dict(self) -> dict[str, Any]:
        """Nested plain dictionaries, names without units."""
        return {name: value.as_dict() if isinstance(value, Record) else value
                for name, value in self._values.items()}

    def __repr__(self) -> str:
        return "Record(" + ", ".join(
            f"{name}=..." if isinstance(value, Record) else f"{name}={value!r}"
            for name, value in self._values.items()) + ")"


def _with_ending(values: Mapping[str, Any], full: str,
                 name: str) -> dict[str, Any]:
    """Values of ``name_unit`` by names that have the unit, too: the parts of
    ``wall_clock_s`` are in s."""
    ending = full[len(name):]
    return {key if split_unit(key)[1] != "1" else key + ending: value
            for key, value in values.items()}
