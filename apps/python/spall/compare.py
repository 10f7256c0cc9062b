"""Several runs beside each other."""
from __future__ import annotations

import pathlib
from typing import Any, Iterable, Iterator, Sequence

import numpy as np

from .errors import InputError
from .plots import draw, new_axes
from .run import Run
from .table import Record, Table
from .units import table_unit

# What a run costs and how it was started is no result.
_LEFT_OUT = ("Case/title", "Output/", "Run/")


class Comparison:
    """Runs with what their cases differ in and what came out.

    ``comparison.table`` has a row for each run: its name, every key of the
    case that differs, and every number of the summaries that all runs have.
    """

    def __init__(self, runs: Iterable[Run | str | pathlib.Path]) -> None:
        self.runs = [one if isinstance(one, Run) else Run(one)
                     for one in runs]
        if not self.runs:
            raise InputError("compare: at least one run must be given")
        self._cases = [{name: value for name, value, _ in run.case.flat()}
                       for run in self.runs]

    @property
    def differences(self) -> dict[str, list[Any]]:
        """Keys of the cases that differ, Section/key, with the value of each
        run; None where a run has no such key."""
        keys = dict.fromkeys(key for case in self._cases for key in case)
        found = {}
        for key in keys:
            values = [case.get(key) for case in self._cases]
            if any(value != values[0] for value in values) and \
                    not key.startswith(_LEFT_OUT):
                found[key] = values
        return found

    @property
    def table(self) -> Table:
        """One row for each run."""
        columns: dict[str, np.ndarray] = {
            "run": np.array([run.name for run in self.runs])}
        for key, values in self.differences.items():
            columns[key] = np.array(values) if all(
                isinstance(one, (int, float)) for one in values) else \
                np.array([str(one) for one in values])
        columns.update(self._results())
        return Table(columns, "comparison",
                     {key: self._unit(key) for key in self.differences})

    def _unit(self, key: str) -> str:
        """Unit of Section/key, which not every run may have."""
        return next(table_unit(run.case.unit(key))
                    for run, case in zip(self.runs, self._cases)
                    if key in case)

    def _results(self) -> dict[str, np.ndarray]:
        summaries = [dict(self._numbers(run.summary)) for run in self.runs]
        common = [name for name in summaries[0]
                  if all(name in one for one in summaries)]
        return {name: np.array([one[name] for one in summaries], dtype=float)
                for name in common}

    @staticmethod
    def _numbers(record: Record, above: str = "") -> Iterator[
            tuple[str, float]]:
        for short, value in record.items():
            if isinstance(value, (bool, int, float)):
                yield above + record.full_name(short), float(value)
            elif isinstance(value, Record):
                yield from Comparison._numbers(value, f"{above}{short}/")

    def plot(self, x: str, y: str, table: str = "history",
             axes: Any = None) -> Any:
        """A column over another of a table of each run (needs matplotlib).
        Only rows of the loading are drawn of history."""
        axes = new_axes(axes)
        for run in self.runs:
            rows = run.loading if table == "history" else run.table(table)
            draw(axes, rows, x, y, label=run.name)
        axes.legend()
        return axes

    def __len__(self) -> int:
        return len(self.runs)


def compare(runs: Sequence[Run | str | pathlib.Path]) -> Comparison:
    """Puts runs, or their folders, beside each other."""
    return Comparison(runs)
