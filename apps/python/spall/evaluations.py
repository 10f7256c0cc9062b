"""Runs of parameter sets over seeds, each done once and stored."""
from __future__ import annotations

import dataclasses
import hashlib
import pathlib
import threading
from concurrent.futures import ThreadPoolExecutor
from typing import Any, Callable, Mapping, Sequence

import numpy as np

from .case import Case
from .errors import InputError, RunError
from .prm import prm_text
from .run import Run
from .table import Table
from .targets import Target, require_finite
from .units import table_unit

#: Key or keys of the case -> (lower, upper) or (lower, start, upper).
Ranges = Mapping[str | tuple[str, ...], tuple[float, ...]]


@dataclasses.dataclass(frozen=True)
class Fitted:
    """A parameter that is fitted: one number for one key or several."""

    keys: tuple[str, ...]
    lower: float
    start: float
    upper: float

    @property
    def name(self) -> str:
        """Section/key, the first where there are several."""
        return self.keys[0]

    def value(self, share: float) -> float:
        """Of a share of the range. Six digits tell parameter sets apart."""
        return float(f"{self.lower + share * (self.upper - self.lower):.6g}")

    def share(self) -> float:
        """The start as a share of the range."""
        return (self.start - self.lower) / (self.upper - self.lower)


def fitted_parameters(case: Case, ranges: Ranges) -> list[Fitted]:
    """The parameters with their ranges, checked against the case."""
    if not isinstance(ranges, Mapping):
        raise InputError(f"calibrate: parameters = {ranges!r}: must be a "
                         "dictionary of ranges by Section/key")
    found = []
    for keys, limits in ranges.items():
        keys = (keys,) if isinstance(keys, str) else tuple(keys)
        if not isinstance(limits, (tuple, list)):
            raise InputError(f"{keys[0]}: the range {limits!r} must be (lower, "
                             "upper) or (lower, start, upper)")
        for limit in limits:
            require_finite(f"{keys[0]}: limit of the range", limit)
        if len(limits) == 2:
            limits = (limits[0], 0.5 * sum(limits), limits[1])
        if len(limits) != 3 or not limits[0] < limits[2] or \
                not limits[0] <= limits[1] <= limits[2]:
            raise InputError(f"{keys[0]}: the range {limits} must be (lower, "
                             "upper) or (lower, start, upper)")
        for key in keys:
            if case.parameter(key).type != "number":
                raise InputError(f"{key}: only numbers can be fitted")
            for value in limits:
                case.parameter(key).checked(value)
        found.append(Fitted(keys, *map(float, limits)))
    if not found:
        raise InputError("calibrate: no parameter was given")
    return found


class BudgetSpent(Exception):
    """As many parameter sets as were allowed have been run."""


class Evaluations:
    """Outcomes of parameter sets. The runs of a set are in a folder that is
    named by the case, so that they are found again by a later call."""

    def __init__(self, case: Case, targets: Sequence[Target],
                 fitted: Sequence[Fitted], seeds: Sequence[int],
                 folder: pathlib.Path, **how: Any) -> None:
        self.case, self.targets, self.fitted = case, targets, fitted
        self.seeds, self.folder = list(seeds), folder
        self.max_sets: int = how.pop("max_sets")
        self._jobs: int = how.pop("jobs")
        self._report: Callable[[str], object] | None = how.pop("progress")
        self._how = how
        self.measured = np.concatenate([one.measured() for one in targets])
        self.deviations = np.concatenate([one.deviations()
                                          for one in targets])
        #: values of a set -> outcomes (n_seeds, n_measured)
        self.done: dict[tuple[float, ...], np.ndarray] = {}
        self._units: list[str] = []  #: of the outcomes, by a run
        self._lock = threading.Lock()

    def values(self, shares: np.ndarray) -> tuple[float, ...]:
        """Parameters of shares of their ranges."""
        return tuple(one.value(share)
                     for one, share in zip(self.fitted, shares))

    def case_of(self, values: Sequence[float]) -> Case:
        """The case with these parameters."""
        case = self.case.copy()
        for one, value in zip(self.fitted, values):
            for key in one.keys:
                case[key] = value
        return case

    def runs(self, values: Sequence[float]) -> list[Run]:
        """One run for each seed; those that are not complete are made."""
        case = self.case_of(values)
        del case[case.seed_key]
        text = prm_text("", case.resolved())
        name = hashlib.sha256(text.encode()).hexdigest()[:12]
        with ThreadPoolExecutor(self._jobs) as pool:
            return list(pool.map(
                lambda seed: self._run(case, seed,
                                       self.folder / f"set_{name}"),
                self.seeds))

    def _run(self, case: Case, seed: int, folder: pathlib.Path) -> Run:
        case = case.copy()
        case[case.seed_key] = seed
        out = folder / f"seed_{seed}"
        if (out / "summary.json").exists() and Run(out).is_complete:
            return Run(out)
        can_resume = (out / "checkpoint" / "state.bin").exists()
        folder.mkdir(parents=True, exist_ok=True)
        run = case.run(out, resume=can_resume,
                       overwrite=out.exists() and not can_resume,
                       preparations=self.folder / "preparations", **self._how)
        if not run.is_complete:
            raise RunError(f"{out}: the run was stopped")
        return run

    def outcomes(self, shares: np.ndarray) -> np.ndarray:
        """(n_seeds, n_measured) of shares of the ranges."""
        values = self.values(shares)
        if values not in self.done:
            if len(self.done) >= self.max_sets:
                raise BudgetSpent
            runs = self.runs(values)
            self.done[values] = np.array([
                np.concatenate([one.computed(run) for one in self.targets])
                for run in runs])
            self._units = [one.unit(runs[0]) for one in self.targets
                           for _ in one.labels()]
            self._write()
            if self._report:
                self._report(self._line(values))
        return self.done[values]

    def residuals(self, shares: np.ndarray) -> np.ndarray:
        """(mean over the seeds - measured) / deviation [1]."""
        return (self.outcomes(shares).mean(axis=0) - self.measured) / \
            self.deviations

    def cost(self, values: tuple[float, ...]) -> float:
        """Root mean square of the residuals of a set [1]."""
        residual = (self.done[values].mean(axis=0) - self.measured) / \
            self.deviations
        return float(np.sqrt(np.mean(residual**2)))

    def best(self) -> tuple[float, ...]:
        """The set with the smallest residual."""
        return min(self.done, key=self.cost)

    def jacobian(self, shares: np.ndarray, step: float) -> np.ndarray:
        """Derivatives of the residuals by the shares, by differences over
        ``step`` to both sides, or to one at the end of a range."""
        columns = []
        for k in range(len(shares)):
            up, down = shares.copy(), shares.copy()
            up[k] = min(1.0, shares[k] + step)
            down[k] = max(0.0, shares[k] - step)
            columns.append((self.residuals(up) - self.residuals(down)) /
                           (up[k] - down[k]))
        return np.array(columns).T

    def table(self) -> Table:
        """A row for each set: parameters, residual and mean outcomes."""
        columns = {one.name: np.array([values[k] for values in self.done])
                   for k, one in enumerate(self.fitted)}
        units = {name: table_unit(self.case.unit(name)) for name in columns}
        columns["residual_1"] = np.array([self.cost(one)
                                          for one in self.done])
        means = np.array([one.mean(axis=0) for one in self.done.values()])
        labels = [label for one in self.targets for label in one.labels()]
        for label, unit, column in zip(labels, self._units, means.T):
            columns[label] = column
            units[label] = unit
        return Table(columns, str(self.folder / "sets.csv"), units)

    def _write(self) -> None:
        self.folder.mkdir(parents=True, exist_ok=True)
        self.table().write_csv(self.folder / "sets.csv")

    def _line(self, values: tuple[float, ...]) -> str:
        shown = ", ".join(f"{one.name} = {value:g}"
                          for one, value in zip(self.fitted, values))
        return f"set {len(self.done)}: {shown}: residual " \
               f"{self.cost(values):.4g}"
