"""The folder of a study: many runs, one table."""
from __future__ import annotations

import functools
import pathlib
from typing import Any, Iterator

import numpy as np

from .errors import InputError
from .run import Run
from .table import Table


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
        """All cases."""
        return Table.read(self.folder / "study.csv")

    @property
    def keys(self) -> list[str]:
        """The swept keys, Section/key or Variants."""
        names = list(self.table)
        return names[names.index("is_done") + 1:names.index("seed")]

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
        """Unit of an outcome, or of a swept key as the case of a run has
        it."""
        if name in self.keys and self.runs and name in self.runs[0].case:
            return self.runs[0].case.unit(name)
        return self.table.unit(name)

    def mean(self, outcome: str, by: str) -> Table:
        """Mean and standard deviation over the seeds of an outcome, and their
        number, for each value of a swept key. Cases that are not done are
        left out. The other keys are averaged over, too."""
        done = self.table.rows(self.table["is_done"] == 1)
        full, ending = self.table.full_name(outcome), ""
        if full.startswith(outcome):
            ending = full[len(outcome):]
        groups = [(value, done[outcome][done[by] == value])
                  for value in np.unique(done[by])]
        columns: dict[str, Any] = {
            by: np.array([value for value, _ in groups]),
            f"{outcome}{ending}": np.array([g.mean() for _, g in groups]),
            f"{outcome}_deviation{ending}": np.array(
                [g.std(ddof=1) if len(g) > 1 else np.nan for _, g in groups]),
            "n_cases": np.array([len(g) for _, g in groups])}
        return Table(columns, str(self.folder))

    def __iter__(self) -> Iterator[Run]:
        return iter(self.runs)

    def __len__(self) -> int:
        return self.table.n_rows

    def __repr__(self) -> str:
        return f"Study({str(self.folder)!r})"
