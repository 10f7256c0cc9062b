"""What a calibration aims at: measured values and curves."""
from __future__ import annotations

import dataclasses
import numbers
from typing import Any, Mapping, Protocol, Sequence, runtime_checkable

import numpy as np

from .errors import InputError
from .run import Run
from .table import Table


@runtime_checkable
class Target(Protocol):
    """Measured numbers, and the same of a run."""

    name: str

    def labels(self) -> list[str]:
        """What each measured number is, for a header."""

    def unit(self, run: Run) -> str:
        """Unit of the measured numbers."""

    def measured(self) -> np.ndarray:
        """What was measured."""

    def deviations(self) -> np.ndarray:
        """Standard deviation of each measured number, in its unit."""

    def computed(self, run: Run) -> np.ndarray:
        """The same numbers of a run."""


def require_finite(what: str, value: Any) -> None:
    """InputError unless the value is a finite number."""
    if isinstance(value, bool) or not isinstance(value, numbers.Real) or \
            not np.isfinite(float(value)):
        raise InputError(f"{what} = {value!r}: must be a finite number")


def _deviations(measured: np.ndarray,
                given: float | Sequence[float] | None,
                name: str) -> np.ndarray:
    """Those given; else the largest measured value, so that residuals are
    shares of it."""
    if given is None:
        given = float(np.max(np.abs(measured))) or 1.0
    try:
        values = np.broadcast_to(np.asarray(given, dtype=float),
                                 measured.shape)
    except (TypeError, ValueError):
        raise InputError(f"{name}: deviation = {given!r}: must be a number, or "
                         f"{len(measured)} numbers") from None
    if not np.all(np.isfinite(values) & (values > 0)):
        raise InputError(f"{name}: deviation = {given}: must be above 0 and "
                         "finite")
    return values


@dataclasses.dataclass(frozen=True)
class Value:
    """A number of the summary, as ``permanent_axial_strain``.

    ``value`` is in the unit of the summary, ``deviation`` the standard
    deviation of the measurement in this unit. Without it the residual is a
    share of the value.
    """

    name: str
    value: float
    deviation: float | None = None

    def __post_init__(self) -> None:
        require_finite(f"Value: {self.name}", self.value)

    def labels(self) -> list[str]:
        return [self.name]

    def unit(self, run: Run) -> str:
        return run.summary.unit(self.name)

    def measured(self) -> np.ndarray:
        return np.array([self.value], dtype=float)

    def deviations(self) -> np.ndarray:
        return _deviations(self.measured(), self.deviation, self.name)

    def computed(self, run: Run) -> np.ndarray:
        value = run.summary[self.name]
        require_finite(f"{run.folder}: {self.name}", value)
        return np.array([float(value)])


@dataclasses.dataclass(frozen=True)
class Curve:
    """Points of a curve: column ``y`` of a table over its column ``x``.

    ``points`` maps x to y in the units of the table. Between the rows of a
    run y is linear. ``deviation`` is the standard deviation of the measured
    y, one for all points or one for each; without it residuals are shares of
    the largest y.
    """

    x: str
    y: str
    points: dict[float, float]
    table: str = "cycles"
    deviation: float | Sequence[float] | None = None

    def __post_init__(self) -> None:
        if not isinstance(self.points, Mapping) or not self.points:
            raise InputError(f"{self.name}: points = {self.points!r}: must be "
                             "a dictionary of y by x with at least one point")
        for x, y in self.points.items():
            require_finite(f"{self.name}: {self.x} of a point", x)
            require_finite(f"{self.name}: {self.y} at {x}", y)

    @property
    def name(self) -> str:
        """"y over x"."""
        return f"{self.y} over {self.x}"

    def labels(self) -> list[str]:
        return [f"{self.y} at {self.x} {x:g}" for x in self.points]

    def unit(self, run: Run) -> str:
        return self._rows(run).unit(self.y)

    def _rows(self, run: Run) -> Table:
        return run.loading if self.table == "history" \
            else run.table(self.table)

    def measured(self) -> np.ndarray:
        return np.array(list(self.points.values()), dtype=float)

    def deviations(self) -> np.ndarray:
        return _deviations(self.measured(), self.deviation, self.name)

    def computed(self, run: Run) -> np.ndarray:
        rows = self._rows(run)
        x, y = rows[self.x], rows[self.y]
        # Rows that go back, as in an unloading, are no part of the curve.
        is_new = np.concatenate([[True],
                                 x[1:] > np.maximum.accumulate(x)[:-1]])
        at = np.array(list(self.points), dtype=float)
        if len(x) == 0 or at.min() < x[0] or at.max() > x[is_new][-1]:
            raise InputError(
                f"{run.folder}: {self.x} of {self.table} does not reach from "
                f"{at.min():g} to {at.max():g}")
        return np.interp(at, x[is_new], y[is_new])
