"""The folder of a study: many runs, one table."""
from __future__ import annotations

import functools
import pathlib
from typing import Any, Iterator

import numpy as np

from .errors import InputError
from .run import Run
from .table import Table
from .units import split_unit, table_unit


class Study:
    """What ``spall study`` has written.

    ``study.table`` has a row for each case: its folder (``run``), whether it
    is done, the value of every swept key, the seed and the outcomes.
    """

    def __init__(self, folder: str | pathlib.Path) -> None:
        self.folder = pathlib.Path(folder)
        if not (self.folder / "study.csv").is_file():
            raise InputError(f"{folder}: is no folder of a study, it has no "
                             "study.csv")

    @functools.cached_property
    def table(self) -> Table:
        """All cases. Columns of swept keys have the units of the cases."""
        table = Table.read(self.folder / "study.csv")
        return table.with_units(self._units_of(_keys_of(table), table["run"]))

    def _units_of(self, keys: list[str], runs: Any) -> dict[str, str]:
        """Units of swept keys, from the first run that has a case."""
        for name in runs:
            if (self.folder / name / "case.prm").is_file():
                case = Run(self.folder / name).case
                return {key: table_unit(case.unit(key)) for key in keys
                        if key in case}
        return {}

    @property
    def keys(self) -> list[str]:
        """The swept keys, Section/key or Variants."""
        return _keys_of(self.table)

    @property
    def outcomes(self) -> list[str]:
        """Names of the outcomes."""
        names = list(self.table)
        return names[names.index("seed") + 1:]

    @functools.cached_property
    def runs(self) -> list[Run]:
        """The runs of the rows of the table."""
        return [Run(self.folder / name) for name in self.table["run"]]

    def unit(self, name: str) -> str:
        """Unit of an outcome or of a swept key, "1" if it has none."""
        return self.table.unit(name)

    def mean(self, outcome: str, by: str) -> Table:
        """Mean and standard deviation over the seeds of an outcome, and their
        number, for each value of a swept key. Cases that are not done are
        left out. The other keys are averaged over, too."""
        done = self.table.rows(self.table["is_done"] == 1)
        full = self.table.full_name(outcome)
        name = split_unit(full)[0]
        groups = [(value, done[outcome][done[by] == value])
                  for value in np.unique(done[by])]
        columns: dict[str, Any] = {
            by: np.array([value for value, _ in groups]),
            full: np.array([g.mean() for _, g in groups]),
            f"{name}_deviation{full[len(name):]}": np.array(
                [g.std(ddof=1) if len(g) > 1 else np.nan for _, g in groups]),
            "n_cases": np.array([len(g) for _, g in groups])}
        return Table(columns, str(self.folder), {by: self.table.unit(by)})

    def __iter__(self) -> Iterator[Run]:
        return iter(self.runs)

    def __len__(self) -> int:
        return self.table.n_rows

    def __repr__(self) -> str:
        return f"Study({str(self.folder)!r})"


def _keys_of(table: Table) -> list[str]:
    names = list(table)
    return names[names.index("is_done") + 1:names.index("seed")]
